// SPDX-License-Identifier: BSD-3-Clause
#include "engine/inspect_payloads.hpp"

#include <algorithm>
#include <cmath>

#include "cambium/error.hpp"

namespace cambium {
namespace {

struct One {
  bool cloud = false, table = false;
  std::size_t points = 0, trees = 0, bytes = 0;
  double farthest = 0;
  std::string error;
};

One look_at(const Node& node) {
  One one;
  if (!node.payload) return one;
  try {
    const Payload payload = node.payload->load();
    one.bytes = payload.bytes();
    if ((one.cloud = payload.cloud != nullptr)) {
      one.points = payload.cloud->size();
      if (one.points > 0)
        one.farthest =
            std::sqrt(double(payload.cloud->points().colwise().squaredNorm().maxCoeff()));
    }
    if ((one.table = payload.trees != nullptr)) one.trees = payload.trees->size();
  } catch (const Error& error) {
    if (error.code() == ErrorCode::cancelled) throw;
    one.error = error.what();
  }
  return one;
}

}  // namespace

PayloadFigures inspect_payloads(const Mission& mission, const ParallelFor& parallel_for,
                                std::vector<std::string>& findings) {
  std::vector<One> found(mission.nodes.size());
  parallel_for(found.size(), [&](std::size_t i) { found[i] = look_at(mission.nodes[i]); });
  PayloadFigures out;
  std::vector<std::size_t> points;
  for (const One& one : found) {
    if (one.cloud) points.push_back(one.points);
    out.clouds += one.cloud;
    out.empty_clouds += one.cloud && one.points == 0;
    out.tree_tables += one.table;
    out.points += one.points;
    out.trees += one.trees;
    out.bytes += one.bytes;
    out.farthest_point = std::max(out.farthest_point, one.farthest);
    if (one.error.empty()) continue;
    ++out.unreadable;
    if (std::find(findings.begin(), findings.end(), one.error) == findings.end())
      findings.push_back(one.error);
  }
  if (points.empty()) return out;
  std::sort(points.begin(), points.end());
  out.fewest_points = points.front();
  out.most_points = points.back();
  out.median_points = double(points[points.size() / 2]);
  return out;
}

}  // namespace cambium
