// SPDX-License-Identifier: BSD-3-Clause
#include "recordings.hpp"

namespace cambium::python {
namespace {

namespace fs = std::filesystem;

bool is_storage(const fs::path& path) {
  const std::string extension = path.extension().string();
  return extension == ".bag" || extension == ".mcap" || extension == ".db3";
}

}  // namespace

bool is_recording(const fs::path& path) {
  std::error_code unreadable;
  if (!fs::is_directory(path, unreadable)) return is_storage(path);
  bool found = false;
  for (fs::directory_iterator it(path, unreadable), end; it != end; it.increment(unreadable)) {
    if (it->path().stem() == "slam_pose_graph") return false;  // it keeps its recording beside it
    found |= is_storage(it->path()) || is_storage(it->path().stem());  // .mcap.zstd
  }
  return found;
}

}  // namespace cambium::python
