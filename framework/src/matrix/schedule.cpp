// SPDX-License-Identifier: BSD-3-Clause
#include "matrix/schedule.hpp"

#include <algorithm>

namespace cambium::matrix {
namespace {

std::size_t shared(const Steps& a, const Steps& b) {
  std::size_t n = 0;
  while (n < a.size() && n < b.size() && a[n] == b[n]) ++n;
  return n;
}

}  // namespace

Schedule::Schedule(std::vector<Steps> jobs)
    : jobs_(std::move(jobs)), state_(jobs_.size(), State::waiting) {}

// What both begin with is either nothing, or in the cache already thanks to a finished job.
bool Schedule::may_run_beside(std::size_t job, std::size_t other) const {
  const std::size_t common = shared(jobs_[job], jobs_[other]);
  for (std::size_t f = 0; f < jobs_.size(); ++f)
    if (state_[f] == State::finished && shared(jobs_[job], jobs_[f]) >= common) return true;
  return common == 0;
}

std::vector<std::size_t> Schedule::ready(std::size_t most) const {
  std::vector<std::size_t> active, out;
  for (std::size_t i = 0; i < jobs_.size(); ++i)
    if (state_[i] == State::running) active.push_back(i);
  for (std::size_t i = 0; i < jobs_.size() && out.size() < most; ++i) {
    if (state_[i] != State::waiting) continue;
    if (!std::all_of(active.begin(), active.end(),
                     [&](std::size_t a) { return may_run_beside(i, a); }))
      continue;
    active.push_back(i);
    out.push_back(i);
  }
  return out;
}

bool Schedule::done() const {
  return std::all_of(state_.begin(), state_.end(), [](State s) { return s == State::finished; });
}

}  // namespace cambium::matrix
