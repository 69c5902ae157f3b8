// SPDX-License-Identifier: BSD-3-Clause
#include "serve/site_path.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace cambium::serve {
namespace {

namespace fs = std::filesystem;

bool harmless(const std::string& path) {
  if (path.empty() || path.front() != '/') return false;
  for (const char c : path)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f || c == '\\') return false;
  return path.find("/.") == std::string::npos;  // "..", ".", and files that are none of the page's
}

bool inside(const fs::path& root, const fs::path& file) {
  return std::mismatch(root.begin(), root.end(), file.begin(), file.end()).first == root.end();
}

}  // namespace

SitePath site_path(const fs::path& root, const std::string& path) {
  if (!harmless(path)) return {SitePath::Answer::refused, {}};
  std::error_code error;
  fs::path file = fs::canonical(root / path.substr(1), error);
  if (error) return {SitePath::Answer::absent, {}};
  if (!inside(root, file)) return {SitePath::Answer::refused, {}};
  if (fs::is_directory(file, error)) {
    if (path.back() != '/') return {SitePath::Answer::redirect, {}};
    file = fs::canonical(file / "index.html", error);
    if (error) return {SitePath::Answer::absent, {}};
    if (!inside(root, file)) return {SitePath::Answer::refused, {}};
  } else if (path.back() == '/') {
    return {SitePath::Answer::absent, {}};
  }
  if (!fs::is_regular_file(file, error)) return {SitePath::Answer::absent, {}};
  return {SitePath::Answer::file, file};
}

const char* content_type(const fs::path& file) {
  static constexpr std::pair<const char*, const char*> types[] = {
      {".html", "text/html; charset=utf-8"},
      {".css", "text/css; charset=utf-8"},
      {".js", "text/javascript; charset=utf-8"},
      {".mjs", "text/javascript; charset=utf-8"},
      {".json", "application/json"},
      {".geojson", "application/geo+json"},
      {".jsonl", "text/plain; charset=utf-8"},
      {".yaml", "text/plain; charset=utf-8"},
      {".tum", "text/plain; charset=utf-8"},
      {".csv", "text/csv; charset=utf-8"},
      {".svg", "image/svg+xml"},
      {".png", "image/png"},
      {".jpg", "image/jpeg"},
      {".jpeg", "image/jpeg"},
      {".webp", "image/webp"},
      {".kml", "application/vnd.google-earth.kml+xml"}};
  const std::string extension = file.extension().string();
  for (const auto& [name, type] : types)
    if (extension == name) return type;
  return "application/octet-stream";
}

}  // namespace cambium::serve
