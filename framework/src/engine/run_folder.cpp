// SPDX-License-Identifier: BSD-3-Clause
#include "engine/run_folder.hpp"

#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>
#include <sstream>

#include "cambium/dialect.hpp"
#include "cambium/error.hpp"
#include "cambium/files.hpp"
#include "cambium/fused.hpp"

namespace cambium {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

[[noreturn]] void refuse(const fs::path& file, const std::string& what) {
  throw Error(ErrorCode::data, file.string(), what);
}

/// What `read` makes of a JSON text; whatever is amiss with it becomes an error that names it.
template <class Read>
auto from_json(const std::string& where, const std::string& text, Read read) {
  try {
    return read(Json::parse(text));
  } catch (const Json::exception& e) {
    throw Error(
        ErrorCode::data, where,
        fmt::format("is not what a run of Cambium writes: {}; run the pipeline again", e.what()));
  }
}

std::uint32_t mission_index(const Atlas& atlas, const std::string& name, const fs::path& file) {
  for (std::uint32_t m = 0; m < atlas.missions.size(); ++m)
    if (atlas.missions[m].mission->name == name) return m;
  refuse(file, fmt::format("names the mission '{}', which is not among those of resolved.yaml; "
                           "was it moved or renamed since the run?",
                           name));
}

void read_islands(const fs::path& file, Atlas& atlas) {
  atlas.islands = from_json(file.string(), read_file(file), [&](const Json& report) {
    std::vector<Island> islands;
    for (const auto& entry : report.at("islands")) {
      Island& island = islands.emplace_back();
      for (const auto& name : entry.at("missions")) {
        const auto m = mission_index(atlas, name.get<std::string>(), file);
        island.missions.push_back(m);
        atlas.missions[m].island = std::uint32_t(islands.size() - 1);
      }
    }
    return islands;
  });
  std::size_t named = 0;
  for (const Island& island : atlas.islands) named += island.missions.size();
  if (named != atlas.missions.size())
    refuse(file, fmt::format("knows {} missions, resolved.yaml {}; did a glob find more folders "
                             "than at the time of the run?",
                             named, atlas.missions.size()));
}

void read_poses(const fs::path& file, Island& island, Atlas& atlas) {
  const Mission fused = read_g2o(file);
  island.georeference = fused.georeference;
  for (const std::uint32_t m : island.missions) {
    MissionState& state = atlas.missions[m];
    std::vector<SE3> poses;
    for (const Node& node : state.mission->nodes) {
      const auto at = fused.index_of(node.id + state.id_offset);
      if (!at)
        refuse(file, fmt::format("has no node {}, which is node {} of '{}'; was the mission "
                                 "changed since the run?",
                                 node.id + state.id_offset, node.id, state.mission->name));
      poses.push_back(fused.nodes[*at].T_mission_node);
    }
    state.T_map_node = std::make_shared<const std::vector<SE3>>(std::move(poses));
  }
}

LoopState loop_state(const std::string& word) {
  for (const auto state : {LoopState::candidate, LoopState::registered, LoopState::accepted})
    if (word == to_string(state)) return state;
  return LoopState::rejected;
}

Loop read_loop(const Json& row, const Atlas& atlas, const fs::path& file) {
  const auto node = [&](const Json& j) -> NodeRef {
    const auto m = mission_index(atlas, j.at("mission"), file);
    const auto at = atlas.missions[m].mission->index_of(j.at("id").get<NodeId>());
    if (!at) refuse(file, fmt::format("names an unknown node: {}", j.dump()));
    return {m, std::uint32_t(*at)};
  };
  Loop loop;
  loop.tail = node(row.at("tail"));
  loop.head = node(row.at("head"));
  loop.state = loop_state(row.at("state"));
  loop.proposed_by = row.at("proposed_by");
  loop.registered_by = row.at("registered_by");
  loop.decided_by = row.at("decided_by");
  loop.reason = row.at("reason");
  for (const auto& [name, value] : row.at("scores").items())
    if (value.is_number()) loop.scores.emplace_back(name, value.get<double>());
  if (row.contains("T_tail_head")) {
    const auto v = row.at("T_tail_head").get<std::array<double, 7>>();
    loop.T_tail_head = {Quat(v[6], v[3], v[4], v[5]), Vec3(v[0], v[1], v[2])};
  }
  loop.weight = row.value("weight", 1.0);
  return loop;
}

void read_ledger(const fs::path& file, Atlas& atlas) {
  std::istringstream lines(read_file(file));
  std::size_t number = 0;
  for (std::string line; std::getline(lines, line);)
    atlas.loops.push_back(from_json(fmt::format("{}:{}", file.string(), ++number), line,
                                    [&](const Json& row) { return read_loop(row, atlas, file); }));
}

}  // namespace

Atlas read_run(const fs::path& run, Atlas atlas) {
  read_islands(run / "report.json", atlas);
  for (std::size_t i = 0; i < atlas.islands.size(); ++i)
    read_poses(run / island_file("fused", i, ".g2o"), atlas.islands[i], atlas);
  read_ledger(run / "ledger.jsonl", atlas);
  return atlas;
}

}  // namespace cambium
