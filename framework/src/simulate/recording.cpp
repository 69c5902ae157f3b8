// SPDX-License-Identifier: BSD-3-Clause
#include "simulate/recording.hpp"

#include <fmt/format.h>

#include "cambium/error.hpp"
#include "simulate/angles.hpp"
#include "simulate/clock.hpp"
#include "simulate/odometry.hpp"
#include "simulate/random.hpp"

namespace cambium::simulate {
namespace {

void check_path(const MissionSpec& m, const std::vector<TruePose>& truth, const StandSpec& stand) {
  const std::string where = "mission '" + m.name + "'";
  if (truth.size() < 2)
    throw Error(ErrorCode::config, where,
                fmt::format("its path has {} nodes, expected 2 or more; make the path longer or "
                            "path.spacing smaller",
                            truth.size()));
  if (std::size_t(m.carried_at) >= truth.size() ||
      2 * std::size_t(m.duplicate_stamps) >= truth.size())
    throw Error(ErrorCode::config, where,
                fmt::format("it has {} nodes; carried_at must be below that, duplicate_stamps "
                            "below half of it",
                            truth.size()));
  for (const TruePose& p : truth) {
    const Vec3& t = p.T_world_base.t;
    if (std::abs(t.x()) > 0.5 * stand.size[0] || std::abs(t.y()) > 0.5 * stand.size[1])
      throw Error(ErrorCode::config, where,
                  fmt::format("its path leaves the stand at ({:.1f}, {:.1f}); enlarge stand.size "
                              "or move the path",
                              t.x(), t.y()));
  }
}

// Nodes 2, 4, 6, ... repeat, until there are `count` of them.
bool repeats_stamp(std::size_t node, int count) {
  return node > 0 && node % 2 == 0 && node / 2 <= std::size_t(count);
}

std::vector<Node> nodes_of(const MissionSpec& m, const std::vector<TruePose>& truth,
                           std::uint64_t seed) {
  const auto believed = believed_poses(truth, m.odometry, m.carried_at, seed);
  // A wrong gravity turns the whole frame of the mission.
  const SE3 T_mission_vertical{about(Vec3::UnitY(), radians(m.gravity_tilt)), Vec3::Zero()};
  std::vector<Node> out;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    Node node;
    node.id = NodeId(i);
    node.stamp =
        repeats_stamp(i, m.duplicate_stamps) ? out.back().stamp : stamp_at(m.start, truth[i].time);
    node.T_mission_node = T_mission_vertical * believed[i];
    out.push_back(std::move(node));
  }
  return out;
}

std::vector<Edge> odometry_edges(const std::vector<Node>& nodes, const OdometrySpec& spec) {
  std::vector<Edge> out;
  for (std::size_t i = 1; i < nodes.size(); ++i) {
    Edge e;
    e.tail = nodes[i - 1].id, e.head = nodes[i].id;
    e.T_tail_head = nodes[i - 1].T_mission_node.inverse() * nodes[i].T_mission_node;
    e.information.setZero();
    e.information.diagonal().head<3>().setConstant(1 / (spec.sigma_position * spec.sigma_position));
    e.information.diagonal().tail<3>().setConstant(1 / (spec.sigma_rotation * spec.sigma_rotation));
    e.tag = "EDGE_SE3:QUAT";
    out.push_back(e);
  }
  return out;
}

}  // namespace

Recording record(const SimulationSpec& spec, std::size_t mission, const Terrain& terrain,
                 const std::vector<Stem>& stems, const std::vector<Stem>& clutter) {
  Recording out;
  out.spec = spec.missions[mission];
  const MissionSpec& m = out.spec;
  // By name: what another mission does, or their order, changes nothing here.
  out.seed = Random(std::uint64_t(spec.seed), m.name).next();
  out.stems = after_growth(after_harvest(stems, m.harvested, std::uint64_t(spec.seed)), m.growth,
                           std::uint64_t(spec.seed));
  std::vector<Stem> obstacles = out.stems;
  obstacles.insert(obstacles.end(), clutter.begin(), clutter.end());
  out.truth = walk(m, terrain, obstacles, out.seed);
  check_path(m, out.truth, spec.stand);
  out.mission.name = m.name;
  out.mission.platform_id = m.platform;
  out.mission.nodes = nodes_of(m, out.truth, out.seed);
  out.mission.edges = odometry_edges(out.mission.nodes, m.odometry);
  out.mission.fixes =
      observe(out.truth, m.gnss, m.start, {spec.latitude, spec.longitude, spec.altitude}, out.seed);
  return out;
}

}  // namespace cambium::simulate
