// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

namespace cambium::matrix {

/// Two-sided p-value of the Mann-Whitney U test: how likely two samples of one distribution are at
/// least this far apart in rank. Exact when no values are tied (and up to 60 of them), else the
/// normal approximation with corrections for ties and continuity. 1 when a sample is empty.
/// H. B. Mann, D. R. Whitney, "On a test of whether one of two random variables is stochastically
/// larger than the other", Ann. Math. Stat. 18 (1947); the recurrence is their eq. (1).
double mann_whitney_p(const std::vector<double>& a, const std::vector<double>& b);

}  // namespace cambium::matrix
