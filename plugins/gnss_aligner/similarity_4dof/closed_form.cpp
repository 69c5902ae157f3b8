// SPDX-License-Identifier: BSD-3-Clause
#include "closed_form.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cambium/fit.hpp"
#include "cambium/statistics.hpp"

namespace similarity_4dof {
namespace {

using cambium::Vec3;
using cambium::gnss::horizontal_variance;

struct Weighted {
  std::vector<Vec3> p_map, p_enu;
  std::vector<double> weight;
  double total = 0;
  Vec3 centre_map = Vec3::Zero();
};

Weighted weighted(const std::vector<Pair>& pairs) {
  Weighted out;
  for (const Pair& pair : pairs) {
    out.p_map.push_back(pair.p_map);
    out.p_enu.push_back(pair.p_enu);
    out.weight.push_back(1 / horizontal_variance(pair.covariance));
    out.total += out.weight.back();
    out.centre_map += out.weight.back() * pair.p_map;
  }
  out.centre_map /= out.total;
  return out;
}

void measure_residuals(const std::vector<Pair>& pairs, Fit& fit) {
  double squares = 0, vertical = 0, chi_squares = 0;
  for (const Pair& pair : pairs) {
    const Vec3 residual = pair.p_map - fit.T_map_enu * pair.p_enu;
    const double horizontal = residual.head<2>().norm();
    squares += horizontal * horizontal;
    chi_squares += horizontal * horizontal / horizontal_variance(pair.covariance);
    vertical += residual.z() * residual.z();
    fit.max_horizontal = std::max(fit.max_horizontal, horizontal);
  }
  const double n = double(pairs.size());
  fit.rmse_horizontal = std::sqrt(squares / n);
  fit.rmse_vertical = std::sqrt(vertical / n);
  // 2n measurements determine x, y and yaw. Two pairs are as good as exact.
  fit.chi = n > 2 ? std::sqrt(chi_squares / (2 * n - 3)) : 0;
}

/// Propagates the full covariances through the estimator: the weights are isotropic, the noise need
/// not be.
void propagate(const std::vector<Pair>& pairs, const Weighted& w, Fit& fit) {
  double second_moment = 0, yaw_variance = 0, position_variance = 0, squares = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    // From the map: the noise of the fixes would make their spread, and so the lever, look longer.
    const Vec3 lever_map = w.p_map[i] - w.centre_map;
    const Eigen::Vector2d r = (fit.T_map_enu.q.conjugate() * lever_map).head<2>();
    const Eigen::Matrix2d C = pairs[i].covariance.topLeftCorner<2, 2>();
    const Eigen::Vector2d tangent(-r.y(), r.x());
    squares += r.squaredNorm();
    second_moment += w.weight[i] * r.squaredNorm();
    yaw_variance += w.weight[i] * w.weight[i] * tangent.dot(C * tangent);
    position_variance += w.weight[i] * w.weight[i] * C.trace() / 2;
  }
  // Receivers under trees are often too sure of themselves: then the residuals have the last word.
  const double inflation = std::max(1.0, fit.chi);
  fit.sigma_yaw = inflation * std::sqrt(yaw_variance) / second_moment;
  if (!(second_moment > 0)) fit.sigma_yaw = std::numeric_limits<double>::infinity();
  fit.sigma_position = inflation * std::sqrt(position_variance) / w.total;
  fit.reach = std::sqrt(squares / double(pairs.size()));
}

}  // namespace

Fit fit(const std::vector<Pair>& pairs) {
  const Weighted w = weighted(pairs);
  Fit out;
  out.T_map_enu = cambium::fit_yaw(w.p_map, w.p_enu, w.weight);
  std::vector<double> dz;
  for (const Pair& pair : pairs) dz.push_back(pair.p_map.z() - pair.p_enu.z());
  out.T_map_enu.t.z() = cambium::median(dz);
  measure_residuals(pairs, out);
  propagate(pairs, w, out);
  return out;
}

}  // namespace similarity_4dof
