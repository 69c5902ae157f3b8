// SPDX-License-Identifier: BSD-3-Clause
#include "engine/inspection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "cambium/pose_graph.hpp"
#include "engine/inspect_payloads.hpp"
#include "io/pose_fields.hpp"

namespace cambium {
namespace {

/// Findings that many lines share: how many, and the first of them.
class Tally {
 public:
  void add(int line) {
    if (count_++ == 0) line_ = line;
  }
  void report(const Mission& mission, const std::string& what,
              std::vector<std::string>& out) const {
    if (count_ == 0) return;
    out.push_back(fmt::format("{}:{}: {}{}", mission.graph_file.string(), line_, what,
                              count_ > 1 ? fmt::format(" ({} such places)", count_) : ""));
  }

 private:
  int line_ = 0;
  std::size_t count_ = 0;
};

void look_at_poses(const Mission& mission, Inspection& out) {
  out.nodes = mission.nodes.size();
  out.low = out.high = mission.nodes.front().T_mission_node.t;
  const Node* previous = nullptr;
  Tally twice, back;
  std::set<Stamp> stamps;
  std::optional<Stamp> latest;
  for (const Node& node : mission.nodes) {
    out.fixed += node.fixed;
    out.low = out.low.cwiseMin(node.T_mission_node.t);
    out.high = out.high.cwiseMax(node.T_mission_node.t);
    if (previous) out.path_length += (node.T_mission_node.t - previous->T_mission_node.t).norm();
    previous = &node;
    if (!node.stamp) continue;
    if (!stamps.insert(*node.stamp).second)
      twice.add(node.line);
    else if (latest && *node.stamp < *latest)
      back.add(node.line);
    latest = node.stamp;
    ++out.stamped;
  }
  if (!stamps.empty()) out.first = *stamps.begin(), out.last = *stamps.rbegin();
  twice.report(mission, "the stamp is that of another vertex, so both get the same payload",
               out.findings);
  back.report(mission, "the stamp goes back in time along the ids", out.findings);
}

void look_at_edges(const Mission& mission, Inspection& out) {
  Tally flat;
  std::vector<double> residuals;
  for (const Edge& edge : mission.edges) {
    ++out.edges[to_string(edge.kind)];
    if (edge.kind != EdgeKind::position &&
        definiteness(edge.information) == Definiteness::semidefinite)
      flat.add(edge.line);
    if (edge.kind != EdgeKind::odometry) continue;
    const auto tail = mission.index_of(edge.tail), head = mission.index_of(edge.head);
    if (!tail || !head) continue;
    residuals.push_back(residual(edge.T_tail_head, mission.nodes[*tail].T_mission_node,
                                 mission.nodes[*head].T_mission_node)
                            .head<3>()
                            .norm());
  }
  flat.report(mission, "the information is singular: the edge leaves a direction free",
              out.findings);
  if (residuals.empty()) return;
  std::sort(residuals.begin(), residuals.end());
  out.median_odometry_residual = residuals[residuals.size() / 2];
  out.largest_odometry_residual = residuals.back();
}

// Neighbours along the path that no edge ties: the drift between them is unbounded.
void look_for_gaps(const Mission& mission, Inspection& out) {
  PoseGraph graph;
  graph.T_map_node.resize(mission.nodes.size());
  std::vector<bool> tied(mission.nodes.size(), false);
  for (const Edge& edge : mission.edges) {
    const auto tail = mission.index_of(edge.tail), head = mission.index_of(edge.head);
    if (!tail || !head || *tail == *head) continue;
    graph.relative.push_back({*tail, *head, {}, Mat6::Identity(), false, {}});
    if (*tail + 1 == *head || *head + 1 == *tail) tied[std::min(*tail, *head)] = true;
  }
  Tally gaps;
  for (std::size_t i = 0; i + 1 < tied.size(); ++i)
    if (!tied[i]) gaps.add(mission.nodes[i + 1].line);
  gaps.report(mission, "no edge ties the vertex to the one before it", out.findings);
  const auto part = components(graph);
  out.parts = 1 + *std::max_element(part.begin(), part.end());
  if (out.parts > 1)
    out.findings.push_back(
        fmt::format("{}: the graph falls into {} parts that no edge connects; "
                    "their positions to each other are only those of the file",
                    mission.graph_file.string(), out.parts));
}

void look_at_fixes(const Mission& mission, Inspection& out) {
  if (mission.fixes.empty() || !out.first) return;
  const Stamp begin = mission.fixes.front().stamp, end = mission.fixes.back().stamp;
  if (end < *out.first || *out.last < begin)
    out.findings.push_back(fmt::format("{}: the GNSS fixes and the poses are of different times",
                                       (mission.folder / "gnss.csv").string()));
}

}  // namespace

const char* to_string(EdgeKind kind) {
  switch (kind) {
    case EdgeKind::odometry:
      return "odometry";
    case EdgeKind::loop:
      return "loop";
    case EdgeKind::prior:
      return "prior";
    case EdgeKind::position:
      return "position";
  }
  return "?";
}

Inspection inspect(const Mission& mission, const ParallelFor& parallel_for) {
  Inspection out;
  out.findings = mission.warnings;
  for (const RawLine& raw : mission.unknown_lines)
    ++out.unknown_lines[raw.text[0] == '#' ? "#"
                                           : raw.text.substr(0, raw.text.find_first_of(" \t"))];
  if (mission.nodes.empty()) return out;
  look_at_poses(mission, out);
  look_at_edges(mission, out);
  look_for_gaps(mission, out);
  look_at_fixes(mission, out);
  out.payloads = inspect_payloads(mission, parallel_for, out.findings);
  return out;
}

}  // namespace cambium
