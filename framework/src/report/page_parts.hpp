// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <map>
#include <string>

namespace cambium {

/// The files of framework/page by name: frame, style and scripts of the report.
const std::map<std::string, std::string>& page_parts();

}  // namespace cambium
