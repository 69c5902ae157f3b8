// SPDX-License-Identifier: BSD-3-Clause
// Where the minimisation starts. A pose graph has many local minima; the start decides which.
#pragma once
#include <vector>

#include "common/loss.hpp"
#include "common/problem.hpp"

namespace cambium::pose_solver {

using Poses = std::vector<SE3>;

/// Poses that need no given ones: the chordal relaxation of all factors, and (under a robust loss)
/// that of the trusted factors with only as many loops as tie them together, which false loops
/// cannot bend.
std::vector<Poses> chordal_starts(const Problem& problem, const Loss& loss);

/// For every component the candidate of the lowest F, the first among equals.
Poses cheapest(const Problem& problem, const std::vector<Poses>& candidates, const Loss& loss);

}  // namespace cambium::pose_solver
