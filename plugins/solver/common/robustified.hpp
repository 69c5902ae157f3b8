// SPDX-License-Identifier: BSD-3-Clause
// What a robust loss makes of a factor's information matrix in the Gauss-Newton model of the cost.
#pragma once
#include <Eigen/Core>

#include "common/loss.hpp"

namespace cambium::pose_solver {

/// Of a factor with Jacobian J: its part of H is J' Omega J, its part of g is J' Omega_r.
template <int N>
struct Robustified {
  Eigen::Matrix<double, N, N> Omega;
  Eigen::Matrix<double, N, 1> Omega_r;

  /// Without loss; `weight` times the information.
  template <class Information, class Residual>
  Robustified(const Information& information, const Residual& r, double weight)
      : Omega(weight * information), Omega_r(Omega * r) {}

  /// Iteratively reweighted least squares.
  void reweigh(double rho_prime) {
    Omega *= rho_prime;
    Omega_r *= rho_prime;
  }

  /// The switch `b` of the factor is an unknown, too, and eliminated (Schur complement): with the
  /// squared residual s, its row of the normal equations reads b r' Omega J d + (s + w^2) db =
  /// w^2 - b (s + w^2).
  void switched(const Loss& loss, double s, double b, double weight) {
    const double best = loss.best_switch(s);
    if (weight > 0) Omega -= Omega_r * Omega_r.transpose() / (weight * (s + loss.width_squared()));
    Omega *= b * b;
    Omega_r *= b * best;
  }
};

}  // namespace cambium::pose_solver
