// SPDX-License-Identifier: BSD-3-Clause
// Poses and information matrices as text has them.
#pragma once
#include "cambium/se3.hpp"
#include "io/fields.hpp"
#include "io/warnings.hpp"

namespace cambium {

/// x y z qx qy qz qw, next in `fields`. A quaternion that is unit up to the rounding of the text
/// keeps its digits, so that it is written back as it came; another is normalised with a warning.
SE3 read_pose(Fields& fields, Warnings& warnings);

enum class Definiteness { positive, semidefinite, indefinite };
Definiteness definiteness(const Mat6& symmetric);

/// The 21 numbers of the upper triangle, row by row; warns when the matrix is indefinite.
Mat6 read_information(const double* upper, int line, Warnings& warnings);

}  // namespace cambium
