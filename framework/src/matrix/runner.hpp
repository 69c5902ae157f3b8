// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <map>
#include <memory>

#include "matrix/job.hpp"

namespace cambium::matrix {

/// Starts jobs as threads become free and collects what they leave.
class Runner {
 public:
  /// `time_limit` [s] of each job.
  Runner(std::vector<Job> jobs, double time_limit, const RunSettings& settings,
         const Engine& engine);

  /// One result a job, in their order. Throws Cancelled.
  std::vector<CellRun> run();

 private:
  struct Running {
    std::unique_ptr<Child> child;
    int threads;
  };

  void start_ready();
  void start(std::size_t job, int threads);
  void wait() const;
  void collect();
  void report(std::size_t job) const;
  [[noreturn]] void cancel();

  std::vector<Job> jobs_;
  double time_limit_;
  const RunSettings& settings_;
  const Engine& engine_;
  Schedule schedule_;
  std::size_t most_;
  int free_threads_;
  std::map<std::size_t, Running> running_;
  std::vector<CellRun> runs_;
};

}  // namespace cambium::matrix
