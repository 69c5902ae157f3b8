// SPDX-License-Identifier: BSD-3-Clause
// Robust losses rho(s) of the squared, whitened residual s = r' Omega r. The formulas and their
// sources are in README.md.
#pragma once
#include <string>
#include <vector>

namespace cambium::pose_solver {

enum class LossKind { none, huber, cauchy, geman_mcclure, dcs };

/// The names in the order of LossKind.
const std::vector<std::string>& loss_names();
LossKind loss_from(const std::string& name);

class Loss {
 public:
  /// `width` in sigmas: where the loss leaves the parabola.
  Loss(LossKind kind, double width) : kind_(kind), w2_(width * width) {}
  Loss() = default;  ///< none

  void evaluate(double s, double rho[3]) const;  ///< rho, rho', rho''
  bool robust() const { return kind_ != LossKind::none; }
  double value(double s) const;
  double weight(double s) const;  ///< rho'(s): the weight of iteratively reweighted least squares

 private:
  LossKind kind_ = LossKind::none;
  double w2_ = 1;  ///< width squared
};

}  // namespace cambium::pose_solver
