// SPDX-License-Identifier: BSD-3-Clause
#include "common/information.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

namespace cambium::pose_solver {

template <int N>
Spectrum project_to_psd(Eigen::Matrix<double, N, N>& information) {
  using Matrix = Eigen::Matrix<double, N, N>;
  const Matrix symmetric = 0.5 * (information + information.transpose());
  information = symmetric;
  // Nearly all are positive definite, which the factorisation tells ten times faster.
  const Eigen::LLT<Matrix> llt(symmetric);
  const auto pivots = llt.matrixLLT().diagonal();
  if (llt.info() == Eigen::Success && pivots.minCoeff() > 1e-6 * pivots.maxCoeff()) return {};
  const Eigen::SelfAdjointEigenSolver<Matrix> eigen(symmetric);
  const auto& values = eigen.eigenvalues();
  const auto& V = eigen.eigenvectors();
  // Eigenvalues are exact to about 1e-15 of the largest: less than that is rounding, not a sign.
  const bool indefinite = values(0) < -1e-12 * values.cwiseAbs().maxCoeff();
  if (indefinite) information = V * values.cwiseMax(0.0).asDiagonal() * V.transpose();
  return {indefinite ? values(0) : 0, values(0) <= 1e-12 * values.cwiseAbs().maxCoeff()};
}

template Spectrum project_to_psd(Eigen::Matrix3d&);
template Spectrum project_to_psd(Eigen::Matrix<double, 6, 6>&);

void square_root(const Eigen::Ref<const Eigen::MatrixXd>& information,
                 Eigen::Ref<Eigen::MatrixXd> U) {
  const Eigen::LLT<Eigen::MatrixXd> llt(information);
  if (llt.info() == Eigen::Success) {
    U = llt.matrixU();
    return;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(information);  // singular
  U = eigen.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal() * eigen.eigenvectors().transpose();
}

}  // namespace cambium::pose_solver
