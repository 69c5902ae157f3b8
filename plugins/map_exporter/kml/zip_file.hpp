// SPDX-License-Identifier: BSD-3-Clause
// A KMZ file: a ZIP archive with one KML document.
#pragma once
#include <string>

namespace kml {

/// The archive with `content` as its only file, not compressed: a track is small, and there is one
/// library less. Source: PKWARE, "APPNOTE.TXT", 6.3.10. Throws Error(data) from 4 GB on.
std::string zip_of(const std::string& name, const std::string& content);

}  // namespace kml
