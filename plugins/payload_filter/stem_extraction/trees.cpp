// SPDX-License-Identifier: BSD-3-Clause
#include "trees.hpp"

#include <algorithm>
#include <cmath>

#include "columns.hpp"

namespace stem_extraction {
namespace {

/// Points at most `radius` away across, from (x, y) and the ground there; their rays, when `views`
/// say where they come from.
Points around(const Columns& columns, const std::vector<View>& views, const Eigen::Vector3d& at,
              double radius) {
  Points out;
  columns.visit(float(at.x()), float(at.y()), float(radius), [&](const Above& p) {
    out.push_back({p.position.cast<double>() - at});
    if (views.empty()) return;
    const View& view = views[p.view];
    const Eigen::Vector2d from = view.position + view.shift;
    out.back().ray = (p.position.head<2>().cast<double>() - from).normalized();
  });
  return out;
}

/// Whether another candidate, so near that it would see the same points, was tried before.
bool tried(const Candidate& c, const std::vector<Candidate>& before) {
  constexpr float near = 0.15f;  // [m]
  return std::any_of(before.begin(), before.end(),
                     [&](const Candidate& o) { return std::hypot(o.x - c.x, o.y - c.y) < near; });
}

/// Whether the candidate lies on, or beside, a stem that was found.
bool taken(const Candidate& c, const std::vector<Found>& found) {
  constexpr double beside = 0.15;  // [m]
  return std::any_of(found.begin(), found.end(), [&](const Found& f) {
    const Eigen::Vector2d d = f.stem.center - Eigen::Vector2d(c.x, c.y);
    return d.norm() < f.stem.radius + beside;
  });
}

bool good(const Judgement& judgement, const Limits& limits) {
  return judgement.reach >= limits.min_height && judgement.score >= limits.min_score;
}

bool overlap(const Stem& a, const Stem& b) {
  return (a.center - b.center).norm() < std::max(0.1, std::max(a.radius, b.radius));
}

/// The same stem, its heights from the ground at its foot instead of that at the candidate.
void put_on_ground(const Ground& ground, Found& f) {
  const Eigen::Vector3d foot = f.base();
  const double height = double(ground.height(float(foot.x()), float(foot.y())));
  if (std::isnan(height)) return;
  const double up = height - f.ground;
  f.stem.center += up * f.stem.lean;
  f.stem.radius += up * f.stem.taper;
  f.ground = height;
}

/// The stem at a candidate, if there is one.
std::optional<Found> tree_at(const Candidate& c, const Columns& columns, const Ground& ground,
                             const Limits& limits, std::uint64_t seed) {
  const double window = limits.fit.max_dbh + 0.2, z = double(ground.height(c.x, c.y));
  const Points points = around(columns, {}, {c.x, c.y, z}, window);
  const auto stem = fit_stem(points, limits.fit, seed);
  if (!stem || stem->center.norm() > 0.5 * window) return std::nullopt;
  Found f{*stem, z, judge(*stem, points)};
  f.stem.center += Eigen::Vector2d(c.x, c.y);
  if (!good(f.judgement, limits)) return std::nullopt;
  put_on_ground(ground, f);
  return f;
}

}  // namespace

Eigen::Vector3d Found::base() const {
  const Eigen::Vector2d foot = stem.center - breast_height * stem.lean;
  return {foot.x(), foot.y(), ground};
}

std::vector<Found> find_trees(const std::vector<Above>& points, const Ground& ground,
                              const Limits& limits, std::uint64_t seed) {
  const Columns columns(points);
  std::vector<Found> found;
  std::vector<Candidate> before;
  for (const Candidate& c : find_candidates(points, ground.range(), limits.candidates)) {
    if (taken(c, found) || tried(c, before)) continue;
    before.push_back(c);
    const auto f = tree_at(c, columns, ground, limits, seed);
    if (!f) continue;
    const auto same = std::find_if(found.begin(), found.end(),
                                   [&](const Found& o) { return overlap(o.stem, f->stem); });
    if (same == found.end())
      found.push_back(*f);
    else if (same->judgement.score < f->judgement.score)
      *same = *f;
  }
  return found;
}

std::vector<Found> fitted_again(const std::vector<Found>& trees, const std::vector<Above>& points,
                                const std::vector<View>& views, const Limits& limits) {
  const Columns columns(points);
  std::vector<Found> out;
  for (Found f : trees) {
    const Eigen::Vector2d at = f.stem.center;
    const Points near =
        around(columns, views, {at.x(), at.y(), f.ground}, limits.fit.max_dbh + 0.2);
    f.stem.center.setZero();
    if (!polish(near, limits.fit, 6, f.stem)) continue;
    f.judgement = judge(f.stem, near);
    f.stem.center += at;
    if (good(f.judgement, limits)) out.push_back(f);
  }
  return out;
}

}  // namespace stem_extraction
