// SPDX-License-Identifier: BSD-3-Clause
// Robust losses rho(s) of the squared, whitened residual s = r' Omega r. The formulas and their
// sources are in README.md.
#pragma once
#include <ceres/loss_function.h>

#include <string>
#include <vector>

namespace cambium::ceres_solver {

enum class LossKind { none, huber, cauchy, geman_mcclure, dcs };

/// The names in the order of LossKind.
const std::vector<std::string>& loss_names();
LossKind loss_from(const std::string& name);

class Loss final : public ceres::LossFunction {
 public:
  /// `width` in sigmas: where the loss leaves the parabola.
  Loss(LossKind kind, double width) : kind_(kind), w2_(width * width) {}

  void Evaluate(double s, double rho[3]) const override;  ///< rho, rho', rho''
  bool robust() const { return kind_ != LossKind::none; }
  double value(double s) const;
  double weight(double s) const;  ///< rho'(s): the weight of iteratively reweighted least squares

 private:
  LossKind kind_;
  double w2_;  ///< width squared
};

}  // namespace cambium::ceres_solver
