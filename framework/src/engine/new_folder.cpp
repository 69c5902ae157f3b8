// SPDX-License-Identifier: BSD-3-Clause
#include "cambium/error.hpp"
#include "engine/mission_files.hpp"
#include "io/temporary.hpp"

namespace cambium {

namespace fs = std::filesystem;

NewFolder::NewFolder(fs::path path) : path_(std::move(path)) {
  if (!path_.has_filename()) path_ = path_.parent_path();  // "mission_a/"
  std::error_code error;
  if (fs::exists(path_) && !(fs::is_directory(path_) && fs::is_empty(path_, error)))
    throw Error(ErrorCode::config, path_.string(),
                "is there already; --out must name a new or an empty folder");
  temporary_ = temporary_name(path_);
  fs::create_directories(temporary_, error);
  if (error) throw Error(ErrorCode::data, path_.string(), "cannot be made: " + error.message());
}

NewFolder::~NewFolder() {
  std::error_code ignored;
  if (!temporary_.empty()) fs::remove_all(temporary_, ignored);
}

void NewFolder::commit() {
  std::error_code error;
  fs::rename(temporary_, path_, error);  // over an empty folder, too
  if (error) throw Error(ErrorCode::data, path_.string(), "cannot be made: " + error.message());
  temporary_.clear();
}

}  // namespace cambium
