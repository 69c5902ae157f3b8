// SPDX-License-Identifier: BSD-3-Clause
#include "simulate/loops.hpp"

#include <algorithm>
#include <cmath>

namespace cambium::simulate {

Footprint footprint(const Cloud& cloud, const SE3& T_world_base) {
  Footprint out;
  out.reserve(cloud.size());
  // 21 bits an axis hold any area of 2000 km.
  const auto key = [](double v) { return std::uint64_t(std::int64_t(std::floor(v)) + (1 << 20)); };
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Vec3 p = T_world_base * Vec3(cloud.points().col(Eigen::Index(i)).cast<double>());
    out.push_back(key(p.x()) << 42 | key(p.y()) << 21 | key(p.z()));
  }
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

double overlap(const Footprint& a, const Footprint& b) {
  if (a.empty() || b.empty()) return 0;
  std::size_t common = 0;
  for (auto i = a.begin(), j = b.begin(); i != a.end() && j != b.end();) {
    if (*i == *j) ++common;
    (*i < *j ? i : j)++;
  }
  return double(common) / double(std::min(a.size(), b.size()));
}

namespace {

struct Box {
  Vec3 low = Vec3::Constant(INFINITY), high = Vec3::Constant(-INFINITY);
};

Box box_of(const Recording& r) {
  Box out;
  for (const TruePose& p : r.truth) {
    out.low = out.low.cwiseMin(p.T_world_base.t);
    out.high = out.high.cwiseMax(p.T_world_base.t);
  }
  return out;
}

/// Whether any two nodes of the missions can be so near: of a hundred missions most pairs cannot.
bool reach(const Box& a, const Box& b, double distance) {
  const Vec3 gap = (a.low - b.high).cwiseMax(b.low - a.high).cwiseMax(0.0);
  return gap.norm() <= distance;
}

}  // namespace

std::vector<LoopPair> true_loops(const std::vector<Recording>& recordings,
                                 const std::vector<std::vector<Footprint>>& footprints,
                                 const LoopsSpec& spec) {
  std::vector<LoopPair> out;
  const auto consider = [&](LoopPair p) {
    const Vec3 a = recordings[p.tail_mission].truth[p.tail].T_world_base.t;
    const Vec3 b = recordings[p.head_mission].truth[p.head].T_world_base.t;
    p.baseline = (b - a).norm();
    if (p.baseline > spec.max_baseline) return;
    p.overlap = overlap(footprints[p.tail_mission][p.tail], footprints[p.head_mission][p.head]);
    if (p.overlap > 0 && p.overlap >= spec.min_overlap) out.push_back(p);
  };
  std::vector<Box> boxes;
  for (const Recording& r : recordings) boxes.push_back(box_of(r));
  for (std::size_t m = 0; m < recordings.size(); ++m)
    for (std::size_t i = 0; i < footprints[m].size(); ++i)
      for (std::size_t n = m; n < recordings.size(); ++n) {
        if (!reach(boxes[m], boxes[n], spec.max_baseline)) continue;
        for (std::size_t j = n == m ? i + std::size_t(spec.min_gap) : 0; j < footprints[n].size();
             ++j)
          consider({m, i, n, j, 0, 0});
      }
  return out;
}

}  // namespace cambium::simulate
