// SPDX-License-Identifier: BSD-3-Clause
#include "common/unpacking.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>

#include "cambium/error.hpp"

extern char** environ;

namespace las {
namespace {

constexpr int not_installed = 97;  // exit code of the script, as of a python3 that is not there

constexpr const char* script = R"(
import sys
try:
    import laspy, lazrs
except ModuleNotFoundError:
    sys.exit(97)
try:
    with laspy.open(sys.argv[1]) as file:
        for points in file.chunk_iterator(1 << 17):
            sys.stdout.buffer.write(points.array.tobytes())
except BrokenPipeError:
    sys.exit(1)
except BaseException as error:
    sys.exit(f"{type(error).__name__}: {error}")
)";

struct Pipe {
  int end[2] = {-1, -1};
  Pipe() {
    // Other children of this process must not hold it open.
    if (::pipe2(end, O_CLOEXEC) != 0) end[0] = end[1] = -1;
  }
};

}  // namespace

Unpacking::Unpacking(const std::filesystem::path& path) : path_(path) {
  const Pipe points, words;
  points_ = points.end[0], words_ = words.end[0];
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, points.end[1], 1);
  posix_spawn_file_actions_adddup2(&actions, words.end[1], 2);
  std::string name = path.string();
  const char* arguments[] = {"python3", "-c", script, name.c_str(), nullptr};
  if (::posix_spawnp(&child_, "python3", &actions, nullptr, const_cast<char**>(arguments),
                     environ) != 0)
    child_ = -1;
  posix_spawn_file_actions_destroy(&actions);
  ::close(points.end[1]), ::close(words.end[1]);
}

Unpacking::~Unpacking() {
  ::close(points_), ::close(words_);  // a child that still writes ends here
  if (child_ > 0) ::waitpid(child_, nullptr, 0);
}

void Unpacking::read(std::string& block) {
  for (std::size_t done = 0; done < block.size();) {
    const ssize_t got = child_ > 0 ? ::read(points_, block.data() + done, block.size() - done) : 0;
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) fail();
    done += std::size_t(got);
  }
}

void Unpacking::fail() {
  int status = not_installed << 8;
  std::string said(400, '\0');
  if (child_ > 0) {
    const ssize_t got = ::read(words_, said.data(), said.size());
    said.resize(got > 0 ? std::size_t(got) : 0);
    ::waitpid(child_, &status, 0);
    child_ = -1;
  }
  while (!said.empty() && said.back() == '\n') said.pop_back();
  if (WIFEXITED(status) && WEXITSTATUS(status) == not_installed)
    throw cambium::Error(cambium::ErrorCode::data, path_.string(),
                         "is compressed (LAZ), which needs python3 with the packages laspy and "
                         "lazrs (pip install laspy lazrs); or unpack it: docs/formats.md");
  throw cambium::Error(
      cambium::ErrorCode::data, path_.string(),
      said.empty() ? "is compressed (LAZ) and ends before all points that its header promises"
                   : "is compressed (LAZ) and cannot be unpacked: " + said);
}

}  // namespace las
