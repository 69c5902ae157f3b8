// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <limits>

#include "cambium/statistics.hpp"

#include "stem_map.hpp"

namespace tree_match {
namespace {

using cambium::Vec3;

// A modelled stem is known about three times as well as one that was only detected.
constexpr float weight_reconstructed = 1.0f, weight_detected = 0.2f;
constexpr double around = 12.0;  // where the ground counts as that of the node [m]

Table table_of(const cambium::Payload& payload, const cambium::Quat& q_mission_node,
               std::uint32_t node, double max_range) {
  Table out;
  if (!payload.trees) return out;
  for (const cambium::Tree& tree : *payload.trees) {
    const Vec3 p = q_mission_node * tree.base;
    if (!p.allFinite() || p.head<2>().norm() > max_range) continue;
    const float dbh = std::isfinite(tree.dbh) ? float(tree.dbh) : 0.0f;
    out.push_back({{float(p.x()), float(p.y()), float(p.z()), dbh, node, node, 1},
                   tree.reconstructed ? weight_reconstructed : weight_detected});
  }
  return out;
}

/// How high the ground around the node lies, seen from the node [m]; NaN when no tree is near.
double ground(const Table& table) {
  std::vector<double> heights;
  for (const Detection& d : table)
    if (std::hypot(d.stem.x, d.stem.y) < around) heights.push_back(d.stem.z);
  return cambium::median(heights);
}

void forget_doubtful_heights(std::vector<Table>& tables, double max_change) {
  std::vector<double> grounds, known;
  for (const Table& table : tables) {
    grounds.push_back(ground(table));
    if (std::isfinite(grounds.back())) known.push_back(grounds.back());
  }
  const double usual = cambium::median(known);
  for (std::size_t i = 0; i < tables.size(); ++i)
    if (std::abs(grounds[i] - usual) > max_change)
      for (Detection& d : tables[i]) d.stem.z = std::numeric_limits<float>::quiet_NaN();
}

}  // namespace

std::vector<Table> tables(const cambium::MissionView& mission, const MapLimits& limits,
                          const cambium::Context& context) {
  const auto& nodes = mission.mission().nodes;
  std::vector<Table> out;
  for (std::size_t i = 0; i < mission.size(); ++i) {
    context.check_cancelled();
    out.push_back(table_of(mission.payload(i), nodes[i].T_mission_node.q, std::uint32_t(i),
                           limits.max_range));
  }
  forget_doubtful_heights(out, limits.max_clearance_change);
  return out;
}

}  // namespace tree_match
