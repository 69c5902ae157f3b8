// SPDX-License-Identifier: BSD-3-Clause
#include "common/search.hpp"

#include <algorithm>
#include <cmath>

#include "common/occupancy.hpp"

namespace cambium::registration {
namespace {

struct Scored {
  int score;
  SE3 T_target_source;
};

// -n..n steps that reach at least to `limit`.
std::vector<double> offsets(double limit, double step) {
  const int n = int(std::ceil(limit / step - 1e-9));
  std::vector<double> values;
  for (int i = -n; i <= n; ++i) values.push_back(i * step);
  return values;
}

// Scores every translation of the window for one yaw; the points are turned once.
void score_translations(const Occupancy& grid, const Eigen::Matrix3Xf& points, const SE3& start,
                        const SearchWindow& window, std::vector<Scored>& scored) {
  const Eigen::Matrix3Xf turned =
      (start.rotation().cast<float>() * points).colwise() + Eigen::Vector3f(start.t.cast<float>());
  const std::vector<double> across = offsets(window.radius, window.step);
  const std::vector<double> up = offsets(window.height, window.step);
  for (const double x : across)
    for (const double y : across) {
      if (x * x + y * y > window.radius * window.radius + 1e-9) continue;
      for (const double z : up) {
        SE3 T = start;
        T.t += Vec3(x, y, z);
        scored.push_back({grid.score(turned, Eigen::Vector3f(float(x), float(y), float(z))), T});
      }
    }
}

// Neighbouring hypotheses run into the same minimum.
bool distinct(const SE3& a, const SE3& b, const SearchWindow& window) {
  const SE3 d = a.inverse() * b;
  return d.t.norm() > 2.5 * window.step || rotation_angle(d) > 2.5 * window.yaw_step;
}

}  // namespace

std::vector<SE3> search(const Surface& target, const Surface& source, const SE3& guess,
                        const SearchWindow& window) {
  if (window.radius <= 0 && window.yaw <= 0) return {guess};
  const Eigen::Matrix3Xf standing_source = upright(source);
  const Occupancy grid(upright(target), float(window.step));
  if (standing_source.cols() == 0) return {guess};
  std::vector<Scored> scored;
  for (const double yaw : offsets(window.yaw, window.yaw_step)) {
    SE3 start = guess;
    start.q = SE3::from_yaw(yaw).q * guess.q;
    score_translations(grid, standing_source, start, window, scored);
  }
  std::stable_sort(scored.begin(), scored.end(),
                   [](const Scored& a, const Scored& b) { return a.score > b.score; });
  std::vector<SE3> starts;
  for (const Scored& s : scored) {
    if (int(starts.size()) >= window.hypotheses) break;
    const bool is_new = std::all_of(starts.begin(), starts.end(), [&](const SE3& T) {
      return distinct(T, s.T_target_source, window);
    });
    if (is_new) starts.push_back(s.T_target_source);
  }
  return starts;
}

}  // namespace cambium::registration
