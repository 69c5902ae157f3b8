// SPDX-License-Identifier: BSD-3-Clause
// (H + damping D) d = -g, from one step to the next. H changes little once the poses are near the
// minimum, so a factor that was computed before is a nearly perfect preconditioner: a handful of
// conjugate gradient steps, each of two triangular solves, takes the place of a new factorisation,
// which costs tens of them.
#pragma once
#include "common/cholesky.hpp"
#include "common/normal_equations.hpp"

namespace cambium::sparse_lm {

class DampedSystem {
 public:
  explicit DampedSystem(const pose_solver::NormalEquations& equations)
      : equations_(equations), cholesky_(equations.elimination(), 6, equations.H().pattern()) {}

  /// Looks at the equations' H and g as they are now. `near`: they have changed little since the
  /// last call. False: not positive definite.
  bool solve(double damping, bool near, Eigen::VectorXd& d);
  bool factored() const { return factored_; }  ///< some H has been
  /// What the model F + 2 g'd + d'Hd loses by that step.
  double predicted_decrease(double damping, const Eigen::VectorXd& d) const;

 private:
  void scale();
  bool solve_with_old_factor(double damping, Eigen::VectorXd& d) const;

  const pose_solver::NormalEquations& equations_;
  pose_solver::Cholesky cholesky_;
  Eigen::VectorXd D_;
  bool factored_ = false;
};

}  // namespace cambium::sparse_lm
