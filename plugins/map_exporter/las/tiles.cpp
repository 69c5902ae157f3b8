// SPDX-License-Identifier: BSD-3-Clause
#include "tiles.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "common/payloads.hpp"

namespace las {

using namespace cambium;

namespace {

// Points farther away are left out by the exporter too; a tile's number must fit.
constexpr double farthest = 1e8;  // [m]

/// The tiles that one cloud has points in, and its largest intensity.
struct Seen {
  std::set<Tile> tiles;
  float brightest = 0;
};

Seen look(const Cloud& cloud, const SE3& T_map_node, double width) {
  Seen out;
  const auto points = cloud.points();
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const Vec3 p = T_map_node * Vec3(points.col(i).cast<double>());
    if (p.allFinite() && p.cwiseAbs().maxCoeff() < farthest) out.tiles.insert(tile_at(p, width));
  }
  for (const float value : cloud.intensity)
    if (std::isfinite(value)) out.brightest = std::max(out.brightest, value);
  return out;
}

}  // namespace

Tile tile_at(const Vec3& p_map, double width) {
  return {int(std::floor(p_map.x() / width)), int(std::floor(p_map.y() / width))};
}

Tiles tiles_of(const Atlas& atlas, const std::vector<std::uint32_t>& missions, double width,
               const Context& context) {
  Tiles out;
  const auto nodes = map_export::nodes_with_payload(atlas, missions);
  map_export::for_each_payload(atlas, nodes, context, [&](NodeRef node, const Payload& payload) {
    if (!payload.cloud) return;
    const Seen seen = look(*payload.cloud, atlas.T_map_node(node), width);
    for (const Tile& tile : seen.tiles) out.nodes[tile].push_back(node);
    out.brightest = std::max(out.brightest, seen.brightest);
  });
  return out;
}

}  // namespace las
