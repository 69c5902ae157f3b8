// SPDX-License-Identifier: BSD-3-Clause
#include "engine/output_folder.hpp"

#include "cambium/error.hpp"
#include "io/temporary.hpp"

namespace cambium {

namespace fs = std::filesystem;

void open_output_folder(const fs::path& out, const std::string& mark, const std::string& kind) {
  if (out.empty())
    throw Error(ErrorCode::config, "--out", "no folder was named to write " + kind + " to");
  if (fs::exists(out) && !fs::is_directory(out))
    throw Error(ErrorCode::config, out.string(), "is a file; --out must name a folder");
  if (fs::exists(out) && !fs::is_empty(out) && !fs::exists(out / mark))
    throw Error(
        ErrorCode::config, out.string(),
        "holds something that is not " + kind + " of Cambium; choose an empty or new folder");
  std::error_code error;
  fs::create_directories(out, error);
  if (error) throw Error(ErrorCode::data, out.string(), "cannot be made: " + error.message());
  remove_orphans(out);
}

}  // namespace cambium
