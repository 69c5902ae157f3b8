// SPDX-License-Identifier: BSD-3-Clause
#include "engine/mission_checks.hpp"

#include <fmt/format.h>

#include <numbers>

#include "engine/memory_use.hpp"
#include "engine/upright_path.hpp"

namespace cambium {

void check_mission(const Mission& m, const std::filesystem::path& path) {
  const auto refuse = [&](const std::string& what) {
    throw Error(ErrorCode::data, path.string(), what);
  };
  if (m.nodes.empty()) refuse("the mission has no nodes");
  for (std::size_t i = 0; i < m.nodes.size(); ++i) {
    if (i > 0 && m.nodes[i].id <= m.nodes[i - 1].id)
      refuse(fmt::format("the reader gave node {} after node {}; expected ascending ids",
                         m.nodes[i].id, m.nodes[i - 1].id));
    if (!m.nodes[i].T_mission_node.finite())
      refuse(fmt::format("the pose of node {} is not finite", m.nodes[i].id));
  }
  for (const Edge& e : m.edges)
    if (!m.index_of(e.tail) || !m.index_of(e.head))
      refuse(fmt::format("the edge {}-{} (line {}) names a node that is not there", e.tail, e.head,
                         e.line));
}

void check_names(const std::vector<Mission>& missions) {
  for (std::size_t i = 1; i < missions.size(); ++i) {
    const Mission &a = missions[i - 1], &b = missions[i];
    if (a.name == b.name)
      throw Error(ErrorCode::data, b.graph_file.string(),
                  fmt::format("the mission name '{}' is used twice, also by {}; give one of them "
                              "another name with {{path: ..., name: ...}}",
                              a.name, a.graph_file.string()));
  }
}

void warn_of(const Mission& mission, Progress& progress) {
  for (const auto& warning : mission.warnings) progress.log(LogLevel::warning, warning);
  if (const auto off = upright_path(mission))
    progress.log(
        LogLevel::warning,
        fmt::format("mission '{}': its path lies in an upright plane, whose normal is "
                    "{:.0f} deg from z; is its frame z up? Turn the poses of a frame with "
                    "z forward before they are fused ({})",
                    mission.name, *off * 180 / std::numbers::pi, mission.graph_file.string()));
}

void check_memory(const Engine& engine, std::size_t missions, std::size_t before) {
  const std::size_t now = resident_bytes(), used = now > before ? now - before : 0;
  if (used <= engine.memory()) return;
  throw Error(ErrorCode::config, "--memory",
              fmt::format("{} missions take {} before the first step, more than the {} allowed; "
                          "allow at least twice as much, or fuse fewer missions at once",
                          missions, shown_bytes(used), shown_bytes(engine.memory())));
}

}  // namespace cambium
