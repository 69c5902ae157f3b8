// SPDX-License-Identifier: BSD-3-Clause
#include "views.hpp"

#include <Eigen/Cholesky>
#include <cmath>

#include "columns.hpp"

namespace stem_extraction {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double sigma_point = 0.02, sigma_shift = 0.05, sigma_turn = 0.005;  // [m], [m], [rad]

/// What the views saw near one stem.
struct Seen {
  Points raw;  ///< as the submap has them; z above the ground at the stem
  std::vector<std::uint16_t> view;
};

std::vector<Seen> near_stems(const std::vector<Found>& trees, const std::vector<Above>& points) {
  std::vector<Seen> out(trees.size());
  const Columns columns(points);
  for (std::size_t i = 0; i < trees.size(); ++i) {
    const Found& f = trees[i];
    const Vector2d at = f.stem.center;
    columns.visit(float(at.x()), float(at.y()), float(f.stem.radius + 0.25), [&](const Above& p) {
      const Vector3d q(p.position.x(), p.position.y(), p.position.z() - f.ground);
      if (q.z() < lowest_fitted || q.z() > highest_fitted || std::abs(f.stem.residual(q)) > 0.15)
        return;
      out[i].raw.push_back({q});
      out[i].view.push_back(p.view);
    });
  }
  return out;
}

Point moved(const View& view, const Point& p) {
  const Vector2d q = view.corrected(p.position.head<2>());
  return {{q.x(), q.y(), p.position.z()}};
}

/// One Gauss-Newton step of every view's correction, Tukey's weights.
void correct(const std::vector<Seen>& seen, const std::vector<Found>& trees, std::size_t own,
             double cutoff, std::vector<View>& views) {
  std::vector<Eigen::Matrix3d> H(views.size(), Eigen::Matrix3d::Zero());
  std::vector<Vector3d> g(views.size(), Vector3d::Zero());
  for (std::size_t i = 0; i < seen.size(); ++i)
    for (std::size_t k = 0; k < seen[i].raw.size(); ++k) {
      const std::size_t v = seen[i].view[k];
      const Vector3d p = moved(views[v], seen[i].raw[k]).position;
      const double e = trees[i].stem.residual(p), u = e / cutoff;
      if (std::abs(u) >= 1) continue;
      const Vector2d n = trees[i].stem.off_axis(p).head<2>().normalized();
      const Vector2d arm = p.head<2>() - views[v].position;
      const Vector3d J(n.x(), n.y(), n.y() * arm.x() - n.x() * arm.y());
      const double weight = std::pow(1 - u * u, 2) / (sigma_point * sigma_point);
      H[v] += weight * J * J.transpose();
      g[v] += weight * e * J;
    }
  const Vector3d prior(1 / (sigma_shift * sigma_shift), 1 / (sigma_shift * sigma_shift),
                       1 / (sigma_turn * sigma_turn));
  for (std::size_t v = 0; v < views.size(); ++v) {
    if (v == own) continue;
    H[v] += prior.asDiagonal();
    g[v] += prior.cwiseProduct(Vector3d(views[v].shift.x(), views[v].shift.y(), views[v].turn));
    const Vector3d x = H[v].ldlt().solve(-g[v]);
    views[v].shift += x.head<2>();
    views[v].turn += x.z();
  }
}

}  // namespace

Vector2d View::corrected(const Vector2d& p) const {
  const double c = std::cos(turn), s = std::sin(turn);
  const Vector2d d = p - position;
  return position + shift + Vector2d(c * d.x() - s * d.y(), s * d.x() + c * d.y());
}

void align_views(std::vector<View>& views, std::size_t own, const FitLimits& limits,
                 std::vector<Found>& trees, std::vector<Above>& points) {
  const std::vector<Seen> seen = near_stems(trees, points);
  constexpr int rounds = 6;
  for (int round = 0; round < rounds; ++round) {
    const double cutoff = round < rounds / 2 ? 0.12 : 0.07;
    for (int step = 0; step < 2; ++step) correct(seen, trees, own, cutoff, views);
    for (std::size_t i = 0; i < trees.size(); ++i) {
      Points at;
      for (std::size_t k = 0; k < seen[i].raw.size(); ++k)
        at.push_back(moved(views[seen[i].view[k]], seen[i].raw[k]));
      Stem polished = trees[i].stem;
      if (polish(at, limits, 3, polished)) trees[i].stem = polished;
    }
  }
  for (Above& p : points)
    p.position.head<2>() =
        views[p.view].corrected(p.position.head<2>().cast<double>()).cast<float>();
}

}  // namespace stem_extraction
