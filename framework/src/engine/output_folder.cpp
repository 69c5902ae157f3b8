// SPDX-License-Identifier: BSD-3-Clause
#include "engine/output_folder.hpp"

#include <algorithm>

#include "cambium/error.hpp"
#include "io/temporary.hpp"

namespace cambium {

namespace fs = std::filesystem;

namespace {

// A run that was killed while it wrote its mark has left the beginning of that, and nothing else.
bool holds_something(const fs::path& folder) {
  return std::any_of(fs::directory_iterator(folder), fs::directory_iterator(),
                     [](const auto& entry) { return !is_temporary(entry.path()); });
}

}  // namespace

void open_output_folder(const fs::path& out, const std::string& mark, const std::string& kind) {
  if (out.empty())
    throw Error(ErrorCode::config, "--out", "no folder was named to write " + kind + " to");
  if (fs::exists(out) && !fs::is_directory(out))
    throw Error(ErrorCode::config, out.string(), "is a file; --out must name a folder");
  if (fs::exists(out) && holds_something(out) && !fs::exists(out / mark))
    throw Error(
        ErrorCode::config, out.string(),
        "holds something that is not " + kind + " of Cambium; choose an empty or new folder");
  std::error_code error;
  fs::create_directories(out, error);
  if (error) throw Error(ErrorCode::data, out.string(), "cannot be made: " + error.message());
  remove_orphans(out);
}

}  // namespace cambium
