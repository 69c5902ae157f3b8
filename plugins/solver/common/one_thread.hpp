// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <omp.h>

namespace cambium::pose_solver {

/// CHOLMOD asks OpenMP for four threads, even on one core, where they wait for each other. While
/// this lives, what the calling thread calls runs in it alone.
class OneThread {
 public:
  OneThread() : levels_(omp_get_max_active_levels()) { omp_set_max_active_levels(0); }
  ~OneThread() { omp_set_max_active_levels(levels_); }
  OneThread(const OneThread&) = delete;
  OneThread& operator=(const OneThread&) = delete;

 private:
  int levels_;
};

}  // namespace cambium::pose_solver
