// SPDX-License-Identifier: BSD-3-Clause
#include "damped_system.hpp"

namespace cambium::sparse_lm {
namespace {

constexpr int most_steps = 6;      ///< more of them, and a factorisation is the better use of time
constexpr double accuracy = 3e-2;  ///< of d in the norm of H; the cost errs by its square

}  // namespace

bool DampedSystem::solve(double damping, bool near, Eigen::VectorXd& d) {
  scale();
  if (factored_ && near && solve_with_old_factor(damping, d)) return true;
  factored_ = cholesky_.factorize(equations_.H().damped(D_, damping).data());
  if (!factored_) return false;
  d = cholesky_.solve(-equations_.g());
  return d.allFinite();
}

double DampedSystem::predicted_decrease(double damping, const Eigen::VectorXd& d) const {
  return -equations_.g().dot(d) + damping * d.dot(D_.cwiseProduct(d));
}

// Marquardt's scale; the floor is for directions without any factor.
void DampedSystem::scale() {
  D_ = equations_.H().diagonal();
  D_ = D_.cwiseMax(1e-9 * D_.maxCoeff());
}

// Preconditioned conjugate gradients: M. Hestenes, E. Stiefel, 1952.
bool DampedSystem::solve_with_old_factor(double damping, Eigen::VectorXd& d) const {
  Eigen::VectorXd r = -equations_.g(), z = cholesky_.solve(r), p = z;
  double rz = r.dot(z);
  const double enough = accuracy * accuracy * rz;
  d = Eigen::VectorXd::Zero(r.size());
  for (int k = 0; k < most_steps; ++k) {
    const Eigen::VectorXd q = equations_.H() * p + damping * D_.cwiseProduct(p);
    const double curvature = p.dot(q);
    if (!(curvature > 0)) return false;
    const double alpha = rz / curvature;
    d += alpha * p;
    r -= alpha * q;
    z = cholesky_.solve(r);
    const double next = r.dot(z);
    if (next <= enough) return d.allFinite();
    p = z + next / rz * p;
    rz = next;
  }
  return false;
}

}  // namespace cambium::sparse_lm
