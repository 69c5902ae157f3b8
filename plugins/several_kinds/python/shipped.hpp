// SPDX-License-Identifier: BSD-3-Clause
// Scripts that come with this library: files in a folder beside it.
#pragma once
#include <string>
#include <utility>

namespace cambium::python {

/// The folder, absolute.
std::string shipped_folder();

/// Path and class of "file.py:Class".
std::pair<std::string, std::string> shipped_script(const std::string& name);

/// SHA-256 of the files when this library was built, as _use_shipped() of cambium.py computes it.
/// In the library it also makes new scripts a new build, and so new results in the cache.
extern const char* const shipped_digest;

}  // namespace cambium::python
