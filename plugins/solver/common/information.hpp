// SPDX-License-Identifier: BSD-3-Clause
// Information matrices as files bring them: not always symmetric, not always positive.
#pragma once
#include <Eigen/Core>

namespace cambium::pose_solver {

/// What was found in a matrix.
struct Spectrum {
  double negative = 0;    ///< the smallest eigenvalue when it was negative, else 0
  bool singular = false;  ///< negative or, up to rounding, zero
};

/// The nearest positive semi-definite matrix (Frobenius norm; Higham 1988): the symmetric part with
/// its negative eigenvalues set to zero.
template <int N>
Spectrum project_to_psd(Eigen::Matrix<double, N, N>& information);

/// Writes U with U' U = information (symmetric, positive semi-definite), so that |U r|^2 is
/// r' Omega r. A Cholesky factor Omega = L L' gives U = L', not L.
void square_root(const Eigen::Ref<const Eigen::MatrixXd>& information,
                 Eigen::Ref<Eigen::MatrixXd> U);

}  // namespace cambium::pose_solver
