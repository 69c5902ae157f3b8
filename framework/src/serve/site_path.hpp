// SPDX-License-Identifier: BSD-3-Clause
// Which file of a folder an address means, and nothing outside of it.
#pragma once
#include <filesystem>
#include <string>

namespace cambium::serve {

struct SitePath {
  enum class Answer { file, redirect, absent, refused } answer = Answer::absent;
  std::filesystem::path file;  ///< of `file`
};

/// `path` is that of an address with %-sequences decoded once: "/", "/tiles/0/r.bin". A folder means
/// its index.html; without a slash at its end it is a redirect, so that relative addresses in the page
/// hold. Refused: "..", names that begin with a dot, backslashes, control characters, and whatever
/// leads out of `root` through symbolic links. Only regular files are answered. `root` is canonical.
SitePath site_path(const std::filesystem::path& root, const std::string& path);

/// By the extension; application/octet-stream when it is unknown.
const char* content_type(const std::filesystem::path& file);

}  // namespace cambium::serve
