// SPDX-License-Identifier: BSD-3-Clause
// Robust losses rho(s) of the squared, whitened residual s = r' Omega r. The formulas and their
// sources are in README.md.
#pragma once
#include <string>
#include <vector>

namespace cambium::pose_solver {

enum class LossKind { none, huber, cauchy, geman_mcclure, dcs, switchable };

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

  // Switchable constraints: a factor costs b^2 s + w^2 (1 - b)^2, its switch b is an unknown as the
  // poses are, and rho is what is left when every switch is at its best.
  bool switchable() const { return kind_ == LossKind::switchable; }
  double best_switch(double s) const { return w2_ / (w2_ + s); }
  double switched(double s, double b) const { return b * b * s + w2_ * (1 - b) * (1 - b); }
  double width_squared() const { return w2_; }

 private:
  LossKind kind_ = LossKind::none;
  double w2_ = 1;  ///< width squared
};

}  // namespace cambium::pose_solver
