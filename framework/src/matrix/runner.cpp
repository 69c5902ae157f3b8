// SPDX-License-Identifier: BSD-3-Clause
#include "matrix/runner.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace cambium::matrix {
namespace {

/// Fewer side by side when each would have less than this: on a machine of many cores it is memory
/// that is short, and a cell makes use of more threads.
constexpr std::size_t least_memory = std::size_t(512) << 20;

/// Jobs side by side. What the user asks for is done.
std::size_t most_at_once(const RunSettings& settings, std::size_t jobs, const Engine& engine) {
  if (settings.jobs > 0) return settings.jobs;
  const std::size_t roomy = std::max<std::size_t>(1, settings.engine.memory / least_memory);
  return std::min({std::size_t(engine.threads()), std::max<std::size_t>(1, jobs), roomy});
}

std::vector<Steps> all_steps(const std::vector<Job>& jobs) {
  std::vector<Steps> out;
  for (const Job& job : jobs) out.push_back(job.steps);
  return out;
}

}  // namespace

Runner::Runner(std::vector<Job> jobs, double time_limit, const RunSettings& settings,
               const Engine& engine)
    : jobs_(std::move(jobs)),
      time_limit_(time_limit),
      settings_(settings),
      engine_(engine),
      schedule_(all_steps(jobs_)),
      most_(most_at_once(settings, jobs_.size(), engine)),
      free_threads_(engine.threads()),
      runs_(jobs_.size()) {}

std::vector<CellRun> Runner::run() {
  engine_.progress().begin("cells");
  engine_.progress().expect(jobs_.size());
  while (!schedule_.done()) {
    if (engine_.cancelled()) cancel();
    start_ready();
    wait();
    collect();
  }
  return std::move(runs_);
}

// What starts now shares the threads that are free: a cell that must run alone gets them all.
void Runner::start_ready() {
  const auto ready = schedule_.ready(most_ - running_.size());
  for (std::size_t i = 0; i < ready.size(); ++i)
    start(ready[i], std::max(1, free_threads_ / int(ready.size() - i)));
}

void Runner::start(std::size_t job, int threads) {
  auto command = jobs_[job].command;
  command.insert(command.end(), {"--threads", std::to_string(threads), "--memory",
                                 std::to_string(settings_.engine.memory / most_)});
  running_[job] = {std::make_unique<Child>(command, jobs_[job].log, time_limit_), threads};
  free_threads_ -= threads;
  schedule_.start(job);
}

// Wakes up at once when a child ends, and now and then for time limits and Ctrl-C.
void Runner::wait() const {
  std::vector<int> descriptors;
  for (const auto& [job, r] : running_) descriptors.push_back(r.child->descriptor());
  wait_any(descriptors, 0.2);
}

void Runner::collect() {
  for (auto it = running_.begin(); it != running_.end();) {
    if (!it->second.child->ended()) {
      ++it;
      continue;
    }
    const std::size_t job = it->first;
    runs_[job] = read_job(jobs_[job], it->second.child->outcome());
    free_threads_ += it->second.threads;
    schedule_.finish(job);
    it = running_.erase(it);
    report(job);
  }
}

void Runner::report(std::size_t job) const {
  const CellRun& run = runs_[job];
  engine_.progress().advance();
  engine_.progress().log(
      run.status == Status::ok ? LogLevel::info : LogLevel::warning,
      fmt::format("{:<48} {:>8.2f} s  {}{}{}", jobs_[job].name, run.seconds, to_string(run.status),
                  run.message.empty() ? "" : ": ", run.message));
}

void Runner::cancel() {
  for (auto& [job, r] : running_) r.child->stop();
  for (auto& [job, r] : running_)
    while (!r.child->ended()) wait_any({r.child->descriptor()}, 0.2);
  throw Cancelled();
}

}  // namespace cambium::matrix
