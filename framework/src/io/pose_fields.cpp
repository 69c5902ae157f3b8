// SPDX-License-Identifier: BSD-3-Clause
#include "io/pose_fields.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>

#include "cambium/dialect.hpp"

namespace cambium {
namespace {

// Text with 6 digits is off by up to 2e-6 (seen in public graphs); 1e-5 costs 0.01 mm a metre.
constexpr double norm_tolerance = 1e-5;

}  // namespace

Definiteness definiteness(const Mat6& symmetric) {
  const Eigen::Matrix<double, 6, 6> A = symmetric;
  if (A.llt().info() == Eigen::Success) return Definiteness::positive;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> eigen(A, Eigen::EigenvaluesOnly);
  const double rounding = 1e-9 * eigen.eigenvalues().cwiseAbs().maxCoeff();
  return eigen.eigenvalues()(0) < -rounding ? Definiteness::indefinite : Definiteness::semidefinite;
}

SE3 read_pose(Fields& fields, Warnings& warnings) {
  double v[7];
  fields.numbers(v, 7);
  SE3 T{Quat(v[6], v[3], v[4], v[5]), Vec3(v[0], v[1], v[2])};
  const double norm = T.q.norm();
  if (norm == 0) fields.fail("the quaternion is zero, expected a rotation qx qy qz qw of norm 1");
  if (!(norm > 1e-3 && norm < 1e3))
    fields.fail("the quaternion has norm " + format_number(norm) + ", expected 1");
  if (std::abs(norm - 1) > norm_tolerance) {
    T.q.coeffs() /= norm;
    warnings.add(fields.origin().line, "the quaternion is not of norm 1; it was normalised");
  }
  return T;
}

Mat6 read_information(const double* upper, int line, Warnings& warnings) {
  Mat6 information;
  for (int row = 0; row < 6; ++row)
    for (int col = row; col < 6; ++col) information(row, col) = information(col, row) = *upper++;
  if (definiteness(information) == Definiteness::indefinite)
    warnings.add(line,
                 "the information matrix is indefinite (it has a negative eigenvalue); "
                 "solvers use its nearest positive semidefinite matrix");
  return information;
}

}  // namespace cambium
