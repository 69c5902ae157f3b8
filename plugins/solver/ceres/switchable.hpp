// SPDX-License-Identifier: BSD-3-Clause
// Switchable constraints: N. Suenderhauf, P. Protzel, "Switchable Constraints for Robust Pose Graph
// SLAM", IROS 2012.
#pragma once
#include <ceres/cost_function.h>

namespace cambium::ceres_solver {

/// [b r; width (1 - b)] of a cost function r and its switch b, one more parameter block of size 1,
/// behind those of r. No bounds: the best b lies in (0, 1] anyway.
class SwitchableCost final : public ceres::CostFunction {
 public:
  SwitchableCost(const ceres::CostFunction& inner, double width);
  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  const ceres::CostFunction& inner_;
  double width_;
};

}  // namespace cambium::ceres_solver
