// SPDX-License-Identifier: BSD-3-Clause
#include "consensus.hpp"

#include <cmath>

#include "cambium/fit.hpp"

namespace bev_density {
namespace {

using cambium::SE3;
using cambium::Vec3;

struct Pairs {
  std::vector<Vec3> query, reference;
};

/// A turn about the vertical and a shift in the plane.
struct Planar {
  double c = 1, s = 0, x = 0, y = 0;
  bool brings(const Vec3& query, const Vec3& reference, double tolerance) const {
    const double dx = c * query.x() - s * query.y() + x - reference.x();
    const double dy = s * query.x() + c * query.y() + y - reference.y();
    return dx * dx + dy * dy <= tolerance * tolerance;
  }
};

Planar planar(const SE3& T) { return {std::cos(T.yaw()), std::sin(T.yaw()), T.t.x(), T.t.y()}; }

std::size_t count(const Pairs& pairs, const Planar& T, double tolerance) {
  std::size_t out = 0;
  for (std::size_t i = 0; i < pairs.query.size(); ++i)
    out += T.brings(pairs.query[i], pairs.reference[i], tolerance);
  return out;
}

std::vector<std::size_t> inliers(const Pairs& pairs, const Planar& T, double tolerance) {
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < pairs.query.size(); ++i)
    if (T.brings(pairs.query[i], pairs.reference[i], tolerance)) out.push_back(i);
  return out;
}

SE3 fit(const Pairs& pairs, const std::vector<std::size_t>& of) {
  std::vector<Vec3> query, reference;
  for (const std::size_t i : of)
    query.push_back(pairs.query[i]), reference.push_back(pairs.reference[i]);
  return cambium::fit_yaw(reference, query);
}

/// What matches i and j fix; false when they are near each other, or not as far apart here as
/// there.
bool hypothesis(const Pairs& p, std::size_t i, std::size_t j, double tolerance, Planar& out) {
  const double qx = p.query[j].x() - p.query[i].x(), qy = p.query[j].y() - p.query[i].y();
  const double rx = p.reference[j].x() - p.reference[i].x();
  const double ry = p.reference[j].y() - p.reference[i].y();
  const double q = std::hypot(qx, qy), r = std::hypot(rx, ry);
  if (q < 4 * tolerance || r < 4 * tolerance || std::abs(q - r) > tolerance) return false;
  out.c = (qx * rx + qy * ry) / (q * r);
  out.s = (qx * ry - qy * rx) / (q * r);
  const Vec3 a = 0.5 * (p.query[i] + p.query[j]), b = 0.5 * (p.reference[i] + p.reference[j]);
  out.x = b.x() - (out.c * a.x() - out.s * a.y());
  out.y = b.y() - (out.s * a.x() + out.c * a.y());
  return true;
}

}  // namespace

Consensus agree(const Features& query, const Features& reference,
                std::span<const FeatureMatch> matches, const ConsensusOptions& options) {
  Pairs pairs;
  for (const FeatureMatch& m : matches) {
    const auto &q = query.at[m.query], &r = reference.at[m.reference];
    pairs.query.emplace_back(q[0], q[1], q[2]);
    pairs.reference.emplace_back(r[0], r[1], r[2]);
  }
  const std::size_t tried = std::min(matches.size(), std::size_t(options.hypotheses));
  std::size_t most = 0;
  Planar T, best_T;
  for (std::size_t i = 0; i < tried; ++i)
    for (std::size_t j = i + 1; j < tried; ++j) {
      if (!hypothesis(pairs, i, j, options.tolerance, T)) continue;
      const std::size_t agreeing = count(pairs, T, options.tolerance);
      if (agreeing > most) most = agreeing, best_T = T;
    }
  if (most == 0) return {};
  const auto best = inliers(pairs, best_T, options.tolerance);
  Consensus out{best.size(), fit(pairs, best)};
  const auto again = inliers(pairs, planar(out.T_reference_query), options.tolerance);
  if (again.size() >= best.size()) out = {again.size(), fit(pairs, again)};
  return out;
}

}  // namespace bev_density
