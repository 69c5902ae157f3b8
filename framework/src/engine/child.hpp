// SPDX-License-Identifier: BSD-3-Clause
// A process of its own for work that may crash or hang: what it does to itself it does to no other.
#pragma once
#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include <sys/types.h>

namespace cambium {

class Child {
 public:
  using Clock = std::chrono::steady_clock;

  /// Starts a program; what it prints goes to the file `log`. It ends when its parent dies.
  Child(std::vector<std::string> command, const std::filesystem::path& log, double time_limit);
  ~Child();  ///< kills it if it still runs
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// Looks whether it has ended, and stops it when its time is over: SIGTERM, which lets it tidy
  /// up, then SIGKILL.
  bool ended();
  void stop();                                    ///< SIGTERM
  int descriptor() const { return descriptor_; }  ///< readable when it has ended

  struct Outcome {
    int exit_code = 0;  ///< meaningful when signal is 0 and it was not stopped
    int signal = 0;
    bool timed_out = false;
    double seconds = 0;
    std::size_t peak_memory = 0;  ///< bytes
  };
  const Outcome& outcome() const { return outcome_; }  ///< once it has ended

 private:
  pid_t pid_ = -1;
  int descriptor_ = -1;
  Clock::time_point begin_, deadline_;
  bool asked_ = false, over_ = false;
  Outcome outcome_;
};

/// Waits until one of the descriptors is readable, at most `seconds`.
void wait_any(const std::vector<int>& descriptors, double seconds);

}  // namespace cambium
