// SPDX-License-Identifier: BSD-3-Clause
#include "information.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

namespace cambium::ceres_solver {

double project_to_psd(Eigen::Ref<Eigen::MatrixXd> information) {
  const Eigen::MatrixXd symmetric = 0.5 * (information + information.transpose());
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(symmetric);
  const auto& values = eigen.eigenvalues();
  const auto& V = eigen.eigenvectors();
  // Eigenvalues are exact to about 1e-15 of the largest: less than that is rounding, not a sign.
  const bool indefinite = values(0) < -1e-12 * values.cwiseAbs().maxCoeff();
  information = symmetric;
  if (indefinite) information = V * values.cwiseMax(0.0).asDiagonal() * V.transpose();
  return indefinite ? values(0) : std::max(values(0), 0.0);
}

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

}  // namespace cambium::ceres_solver
