// SPDX-License-Identifier: BSD-3-Clause
#include "trees.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace stem_extraction {
namespace {

/// Points in square columns, to gather those around a place.
class Columns {
 public:
  Columns(std::vector<Above> points, double range)
      : points_(std::move(points)), range_(float(range)), width_(int(std::ceil(2 * range / cell))) {
    const auto order = [&](const Above& p) {
      return std::tuple(column(p), p.position.z(), p.position.y(), p.position.x());
    };
    std::sort(points_.begin(), points_.end(),
              [&](const Above& a, const Above& b) { return order(a) < order(b); });
    begin_.assign(std::size_t(width_) * std::size_t(width_) + 1, 0);
    for (const Above& p : points_) ++begin_[std::size_t(column(p)) + 1];
    for (std::size_t i = 1; i < begin_.size(); ++i) begin_[i] += begin_[i - 1];
  }

  /// Points at most `radius` away across, from (x, y) and the ground there.
  Points around(float x, float y, float ground, float radius) const {
    Points out;
    for (int iy = std::max(0, at(y - radius)); iy <= std::min(width_ - 1, at(y + radius)); ++iy)
      for (int ix = std::max(0, at(x - radius)); ix <= std::min(width_ - 1, at(x + radius)); ++ix)
        for (std::size_t i = begin_[index(ix, iy)]; i < begin_[index(ix, iy) + 1]; ++i) {
          const Eigen::Vector3f p = points_[i].position - Eigen::Vector3f(x, y, ground);
          if (p.head<2>().norm() <= radius) out.push_back(p.cast<double>());
        }
    return out;
  }

 private:
  static constexpr float cell = 0.5f;  // [m]
  int at(float v) const { return int(std::floor((v + range_) / cell)); }
  std::size_t index(int ix, int iy) const {
    return std::size_t(iy) * std::size_t(width_) + std::size_t(ix);
  }
  std::size_t column(const Above& p) const {
    const auto inside = [&](float v) { return std::clamp(at(v), 0, width_ - 1); };
    return index(inside(p.position.x()), inside(p.position.y()));
  }

  std::vector<Above> points_;
  float range_;
  int width_;
  std::vector<std::size_t> begin_;
};

/// Whether the candidate lies on, or beside, a stem that was found.
bool taken(const Candidate& c, const std::vector<Found>& found) {
  constexpr double beside = 0.15;  // [m]
  return std::any_of(found.begin(), found.end(), [&](const Found& f) {
    const Eigen::Vector2d d = f.stem.center - Eigen::Vector2d(c.x, c.y);
    return d.norm() < f.stem.radius + beside;
  });
}

bool overlap(const Stem& a, const Stem& b) {
  return (a.center - b.center).norm() < std::max(0.1, std::max(a.radius, b.radius));
}

}  // namespace

Eigen::Vector3d Found::base() const {
  const Eigen::Vector2d foot = stem.center - breast_height * stem.lean;
  return {foot.x(), foot.y(), ground};
}

std::vector<Found> find_trees(std::vector<Above> points, const Ground& ground, const Limits& limits,
                              std::uint64_t seed) {
  const auto candidates = find_candidates(points, limits.candidates);
  const Columns columns(std::move(points), limits.candidates.range);
  const float window = float(limits.fit.max_dbh + 0.2);
  std::vector<Found> found;
  for (const Candidate& c : candidates) {
    if (taken(c, found)) continue;
    const float z = ground.height(c.x, c.y);
    const Points around = columns.around(c.x, c.y, z, window);
    const auto stem = fit_stem(around, limits.fit, seed);
    if (!stem || stem->center.norm() > 0.5 * window) continue;
    Found f{*stem, z, judge(*stem, around)};
    f.stem.center += Eigen::Vector2d(c.x, c.y);
    if (f.judgement.reach < limits.min_height || f.judgement.score < limits.min_score) continue;
    const auto same = std::find_if(found.begin(), found.end(),
                                   [&](const Found& o) { return overlap(o.stem, f.stem); });
    if (same == found.end())
      found.push_back(f);
    else if (same->judgement.score < f.judgement.score)
      *same = f;
  }
  return found;
}

}  // namespace stem_extraction
