// SPDX-License-Identifier: BSD-3-Clause
#include "io/temporary.hpp"

#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <charconv>
#include <string>
#include <vector>

namespace cambium {
namespace {

namespace fs = std::filesystem;
constexpr std::string_view prefix = ".tmp-";

bool writer_lives(const fs::path& temporary) {
  const std::string name = temporary.filename().string();
  pid_t pid = 0;
  std::from_chars(name.data() + prefix.size(), name.data() + name.size(), pid);
  return pid <= 0 || ::kill(pid, 0) == 0 || errno != ESRCH;
}

}  // namespace

fs::path temporary_name(const fs::path& path) {
  static std::atomic<unsigned> counter{0};
  return path.parent_path() / (std::string(prefix) + std::to_string(::getpid()) + "-" +
                               std::to_string(counter++) + "-" + path.filename().string());
}

bool is_temporary(const fs::path& path) { return path.filename().string().starts_with(prefix); }

void remove_orphans(const fs::path& folder) {
  std::vector<fs::path> orphans;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file() && is_temporary(entry.path()) && !writer_lives(entry.path()))
      orphans.push_back(entry.path());
  std::error_code gone;
  for (const fs::path& file : orphans) fs::remove(file, gone);
}

}  // namespace cambium
