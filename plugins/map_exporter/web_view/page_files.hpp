// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <utility>
#include <vector>

namespace web_view {

/// The page by file name: index.html, page.css, page.js. Made by page/build.mjs.
const std::vector<std::pair<std::string, std::string>>& page_files();

}  // namespace web_view
