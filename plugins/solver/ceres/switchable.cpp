// SPDX-License-Identifier: BSD-3-Clause
#include "switchable.hpp"

#include <Eigen/Core>

namespace cambium::ceres_solver {

SwitchableCost::SwitchableCost(const ceres::CostFunction& inner, double width)
    : inner_(inner), width_(width) {
  set_num_residuals(inner.num_residuals() + 1);
  *mutable_parameter_block_sizes() = inner.parameter_block_sizes();
  mutable_parameter_block_sizes()->push_back(1);
}

// Jacobians are row-major, so the inner function writes the first rows of the larger ones in place.
bool SwitchableCost::Evaluate(double const* const* parameters, double* residuals,
                              double** jacobians) const {
  if (!inner_.Evaluate(parameters, residuals, jacobians)) return false;
  const auto& sizes = inner_.parameter_block_sizes();
  const int rows = inner_.num_residuals();
  const double b = parameters[sizes.size()][0];
  Eigen::Map<Eigen::VectorXd> r(residuals, rows + 1);
  r[rows] = width_ * (1 - b);
  if (jacobians) {
    if (double* by_b = jacobians[sizes.size()])
      Eigen::Map<Eigen::VectorXd>(by_b, rows + 1) << r.head(rows), -width_;
    for (std::size_t i = 0; i < sizes.size(); ++i) {
      if (!jacobians[i]) continue;
      Eigen::Map<Eigen::VectorXd> J(jacobians[i], (rows + 1) * sizes[i]);
      J.head(rows * sizes[i]) *= b;
      J.tail(sizes[i]).setZero();
    }
  }
  r.head(rows) *= b;
  return true;
}

}  // namespace cambium::ceres_solver
