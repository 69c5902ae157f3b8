// SPDX-License-Identifier: BSD-3-Clause
#include "covariance.hpp"

#include <Eigen/Eigenvalues>

namespace cambium::pcm {

Mat6 diagonal(const Sigma& sigma) {
  Mat6 S = Mat6::Zero();
  S.diagonal().head<3>().setConstant(sigma.translation * sigma.translation);
  S.diagonal().tail<3>().setConstant(sigma.rotation * sigma.rotation);
  return S;
}

Mat6 covariance_of(const SE3& T, const Mat6& information) {
  using Matrix6 = Eigen::Matrix<double, 6, 6>;
  const Matrix6 symmetric = 0.5 * (information + information.transpose());
  const Eigen::SelfAdjointEigenSolver<Matrix6> eigen(symmetric);
  const Matrix6 V = eigen.eigenvectors();
  const Matrix6 S =
      V * eigen.eigenvalues().cwiseMax(1e-6).cwiseInverse().asDiagonal() * V.transpose();
  Matrix6 turn = Matrix6::Identity();  // the residual's translation into the source's frame
  turn.topLeftCorner<3, 3>() = T.rotation().transpose();
  return turn * S * turn.transpose();
}

Mat6 through(const SE3& T, const Mat6& covariance) {
  const Mat6 A = T.adjoint();
  return A * covariance * A.transpose();
}

}  // namespace cambium::pcm
