// SPDX-License-Identifier: BSD-3-Clause
// Which cells run side by side: two that begin with the same steps run one after the other, so that
// the second finds those steps in the cache and nothing is computed twice.
#pragma once
#include <string>
#include <vector>

namespace cambium::matrix {

/// What a job does, step by step; jobs that begin alike share their results so far.
using Steps = std::vector<std::string>;

class Schedule {
 public:
  explicit Schedule(std::vector<Steps> jobs);

  /// Jobs that may start now beside those that run, at most `most`, in their order.
  std::vector<std::size_t> ready(std::size_t most) const;
  void start(std::size_t job) { state_[job] = State::running; }
  void finish(std::size_t job) { state_[job] = State::finished; }
  bool done() const;

 private:
  enum class State { waiting, running, finished };
  bool may_run_beside(std::size_t job, std::size_t other) const;

  std::vector<Steps> jobs_;
  std::vector<State> state_;
};

}  // namespace cambium::matrix
