// SPDX-License-Identifier: BSD-3-Clause
// What moved between two results of the same matrix, and whether it is noise.
#pragma once
#include "matrix/results.hpp"

namespace cambium::matrix {

struct Change {
  enum class Verdict { better, worse, moved, noise, unknown };
  std::string cell;
  Metric metric;                 ///< name, unit and direction
  double before = 0, after = 0;  ///< medians
  std::size_t runs_before = 0, runs_after = 0;
  double p = 1;  ///< Mann-Whitney over the runs
  Verdict verdict = Verdict::unknown;
};
const char* to_string(Change::Verdict verdict);

struct Comparison {
  std::vector<Change> changes;  ///< of metrics whose values are not all the same
  std::size_t same = 0;         ///< metrics that did not move at all
  std::vector<std::string> only_before, only_after;  ///< cells
};

/// A metric moved when p is below `alpha`. With fewer than four runs a side no p can be below
/// 0.05, so the verdict is `unknown`.
Comparison compare(const Results& before, const Results& after, double alpha);

}  // namespace cambium::matrix
