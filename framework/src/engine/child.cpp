// SPDX-License-Identifier: BSD-3-Clause
#include "engine/child.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "cambium/error.hpp"

namespace cambium {
namespace {

constexpr std::chrono::seconds grace{2};  // between SIGTERM and SIGKILL

[[noreturn]] void fail(const std::string& what, const std::string& task) {
  throw Error(ErrorCode::data, what, task + ": " + std::strerror(errno));
}

// Between fork and exec only what is safe in a process with other threads.
pid_t spawn(std::vector<char*>& argv, int log) {
  const pid_t parent = ::getpid(), pid = ::fork();
  if (pid != 0) return pid;
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (::getppid() != parent) ::_exit(127);  // it died before the line above
  ::setpgid(0, 0);  // Ctrl-C reaches the parent only, which then stops its children in order
  ::dup2(log, STDOUT_FILENO);
  ::dup2(log, STDERR_FILENO);
  ::execv(argv[0], argv.data());
  ::_exit(127);
}

}  // namespace

Child::Child(std::vector<std::string> command, const std::filesystem::path& log, double time_limit)
    : begin_(Clock::now()),
      deadline_(begin_ + std::chrono::duration_cast<Clock::duration>(
                             std::chrono::duration<double>(time_limit))) {
  const int out = ::open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (out < 0) fail(log.string(), "cannot be written");
  std::vector<char*> argv;
  for (std::string& a : command) argv.push_back(a.data());
  argv.push_back(nullptr);
  pid_ = spawn(argv, out);
  ::close(out);
  if (pid_ < 0) fail(command[0], "cannot be started");
  descriptor_ = int(::syscall(SYS_pidfd_open, pid_, 0));  // glibc 2.36 lacks the C linkage
}

Child::~Child() {
  if (!over_) {
    ::kill(pid_, SIGKILL);
    ::waitpid(pid_, nullptr, 0);
  }
  ::close(descriptor_);
}

void Child::stop() {
  if (!over_ && !asked_) ::kill(pid_, SIGTERM);
  asked_ = true;
}

bool Child::ended() {
  if (over_) return true;
  int status = 0;
  rusage usage{};
  if (::wait4(pid_, &status, WNOHANG, &usage) == pid_) {
    over_ = true;
    outcome_.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    outcome_.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 0;
    outcome_.seconds = std::chrono::duration<double>(Clock::now() - begin_).count();
    outcome_.peak_memory = std::size_t(usage.ru_maxrss) * 1024;
    return true;
  }
  if (Clock::now() > deadline_) {
    outcome_.timed_out = true;
    stop();
    if (Clock::now() > deadline_ + grace) ::kill(pid_, SIGKILL);
  }
  return false;
}

void wait_any(const std::vector<int>& descriptors, double seconds) {
  std::vector<pollfd> polled;
  for (const int d : descriptors) polled.push_back({d, POLLIN, 0});
  ::poll(polled.data(), polled.size(), int(seconds * 1000));
}

}  // namespace cambium
