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

int steps(double limit, double step) { return int(std::ceil(limit / step - 1e-9)); }

// Scores every translation of the window for one yaw; the points are turned once.
void score_translations(const Occupancy& grid, const Eigen::Matrix3Xf& points, const SE3& start,
                        const SearchWindow& window, std::vector<Scored>& scored) {
  const std::vector<std::int32_t> places = grid.places(
      (start.rotation().cast<float>() * points).colwise() + Eigen::Vector3f(start.t.cast<float>()));
  const int across = steps(window.radius, window.step);
  const int up = steps(window.height, window.step);
  for (int x = -across; x <= across; ++x)
    for (int y = -across; y <= across; ++y) {
      if (x * x + y * y > across * across) continue;
      for (int z = -up; z <= up; ++z) {
        SE3 T = start;
        T.t += window.step * Vec3(x, y, z);
        scored.push_back({grid.score(places, {x, y, z}), T});
      }
    }
}

// Neighbouring hypotheses run into the same minimum.
bool distinct(const SE3& a, const SE3& b, const SearchWindow& window) {
  const SE3 d = a.inverse() * b;
  return d.t.norm() > 2.5 * window.step || rotation_angle(d) > 2.5 * window.yaw_step;
}

}  // namespace

std::vector<SE3> search(const Surface& target, const Patches& source, const SE3& guess,
                        const SearchWindow& window) {
  if (window.radius <= 0 && window.yaw <= 0) return {guess};
  const Eigen::Matrix3Xf standing_source = upright(source);
  if (standing_source.cols() == 0) return {guess};
  const int across = steps(window.radius, window.step);
  const Occupancy grid(upright(target.patches), float(window.step),
                       {across, across, steps(window.height, window.step)});
  std::vector<Scored> scored;
  const int turns = steps(window.yaw, window.yaw_step);
  for (int turn = -turns; turn <= turns; ++turn) {
    SE3 start = guess;
    start.q = SE3::from_yaw(turn * window.yaw_step).q * guess.q;
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
