// SPDX-License-Identifier: BSD-3-Clause
// A file is whole or absent.
#include <sys/resource.h>
#include <csignal>

#include "cambium/error.hpp"
#include "cambium/files.hpp"
#include "support/support.hpp"

namespace cambium {
namespace {

std::size_t entries(const std::filesystem::path& folder) {
  std::size_t n = 0;
  for ([[maybe_unused]] const auto& e : std::filesystem::directory_iterator(folder)) ++n;
  return n;
}

/// A disk with room for `bytes`: the kernel refuses to let files grow beyond it.
class SmallDisk {
 public:
  explicit SmallDisk(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    rlimit now = before_;
    now.rlim_cur = bytes;
    setrlimit(RLIMIT_FSIZE, &now);
  }
  ~SmallDisk() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  rlimit before_{};
  void (*handler_)(int);
};

TEST(AtomicFile, AppearsOnCommitOnly) {
  const testing::TemporaryFolder folder;
  {
    AtomicFile file(folder / "a.txt");
    file.stream() << "half";
    EXPECT_FALSE(std::filesystem::exists(folder / "a.txt"));
  }
  EXPECT_EQ(entries(folder.path()), 0u);
  write_file(folder / "a.txt", "whole");
  EXPECT_EQ(read_file(folder / "a.txt"), "whole");
  EXPECT_EQ(entries(folder.path()), 1u);
}

TEST(AtomicFile, FullDiskLeavesNothingAndKeepsTheOldFile) {
  const testing::TemporaryFolder folder;
  write_file(folder / "a.txt", "old");
  {
    const SmallDisk disk(4096);
    EXPECT_THROW(write_file(folder / "a.txt", std::string(1 << 20, 'x')), Error);
  }
  EXPECT_EQ(read_file(folder / "a.txt"), "old");
  EXPECT_EQ(entries(folder.path()), 1u);
}

TEST(AtomicFile, FolderThatIsAFileIsRefused) {
  const testing::TemporaryFolder folder;
  write_file(folder / "file", "");
  EXPECT_THROW(write_file(folder / "file" / "a.txt", "x"), Error);
}

}  // namespace
}  // namespace cambium
