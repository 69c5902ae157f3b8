// SPDX-License-Identifier: BSD-3-Clause
// LAZ is unpacked by programs that know it well: no library of Debian 12 does.
#pragma once
#include <sys/types.h>

#include <filesystem>
#include <string>

namespace las {

/// The records of a LAZ file as they are in a LAS file, from a child process (python3 with laspy
/// and lazrs), which ends with this object.
class Unpacking {
 public:
  explicit Unpacking(const std::filesystem::path& path);
  ~Unpacking();
  Unpacking(const Unpacking&) = delete;
  Unpacking& operator=(const Unpacking&) = delete;

  /// Fills the block. Throws Error(data) with what the child says when it ends before.
  void read(std::string& block);

 private:
  [[noreturn]] void fail();

  std::filesystem::path path_;
  pid_t child_ = -1;
  int points_ = -1, words_ = -1;  ///< file descriptors of its output and its messages
};

}  // namespace las
