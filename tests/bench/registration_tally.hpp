// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <time.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "cambium/plugin.hpp"
#include "cambium/statistics.hpp"

namespace cambium::bench {

constexpr double degree = M_PI / 180;

// Of this thread: other programs on the machine do not count.
inline double cpu_milliseconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return 1e3 * double(t.tv_sec) + 1e-6 * double(t.tv_nsec);
}

/// The pairs of one line of the table.
struct Tally {
  int pairs = 0, correct = 0, accepted = 0, wrong = 0;
  double distance = 0;  ///< of the accepted, how far |t| is off: no attitude of the truth is in it
  std::vector<double> milliseconds, translation, rotation;

  /// `truth` is T_target_source.
  void add(const Alignment& a, const SE3& truth, double ms) {
    const SE3 error = truth.inverse() * a.T_target_source;
    const bool good = error.t.norm() < 0.5 && rotation_angle(error) < 5 * degree;
    ++pairs;
    correct += good;
    accepted += a.converged && good;
    wrong += a.converged && !good;
    if (a.converged)
      distance = std::max(distance, std::abs(a.T_target_source.t.norm() - truth.t.norm()));
    milliseconds.push_back(ms);
    if (!good) return;
    translation.push_back(error.t.norm());
    rotation.push_back(rotation_angle(error) / degree);
  }
  static void print_header() {
    std::printf(
        "| pairs | n | correct %% | accepted and correct %% | accepted but wrong | accepted: "
        "distance off by at most m | median m | deg | ms |\n"
        "|---|---|---|---|---|---|---|---|---|\n");
  }
  void print(const std::string& label) const {
    if (pairs == 0) return;
    std::printf("| %-34s | %4d | %5.1f | %5.1f | %3d | %5.3f | %5.3f | %4.2f | %4.0f |\n",
                label.c_str(), pairs, 100.0 * correct / pairs, 100.0 * accepted / pairs, wrong,
                distance, median(translation), median(rotation), median(milliseconds));
    std::fflush(stdout);
  }
};

}  // namespace cambium::bench
