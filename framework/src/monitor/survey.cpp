// SPDX-License-Identifier: BSD-3-Clause
#include "monitor/survey.hpp"

#include <fmt/format.h>

#include "engine/missions.hpp"
#include "engine/open_run.hpp"

namespace cambium::monitor {
namespace {

namespace fs = std::filesystem;

/// Whether a node of these payloads has trees. The first twenty of each mission tell: opening
/// thousands of clouds to find nothing would take minutes.
bool has_trees(const PayloadSources& sources) {
  for (const auto& mission : sources) {
    std::size_t looked = 0;
    for (const auto& source : mission) {
      if (!source) continue;
      const Payload payload = source->load();
      if (payload.trees && !payload.trees->empty()) return true;
      if (++looked == 20) break;
    }
  }
  return false;
}

void choose_streams(const Known& known, Survey& out) {
  out.clouds = out.trees = known.atlas;
  out.clouds.payloads = out.trees.payloads = known.streams.at("main");
  if ((out.has_trees = has_trees(*out.trees.payloads))) return;
  for (const auto& [name, sources] : known.streams) {
    if (name == "main" || !has_trees(*sources)) continue;
    out.trees.payloads = sources;
    out.has_trees = true;
    return;
  }
}

std::vector<std::uint32_t> meant(const Atlas& atlas, const std::string& run,
                                 const std::string& mission) {
  std::vector<std::uint32_t> out;
  std::vector<std::string> names;
  for (std::uint32_t m = 0; m < atlas.missions.size(); ++m) {
    names.push_back(atlas.missions[m].mission->name);
    if (mission.empty() || names.back() == mission) out.push_back(m);
  }
  if (out.empty())
    throw Error(ErrorCode::config, run,
                fmt::format("has no mission '{}'{}", mission, suggestion(mission, names)));
  return out;
}

Known read_alone(const std::string& path, const Registry& registry, const Engine& engine) {
  Pipeline pipeline;
  pipeline.missions.push_back({path, "", "", {}, "command line"});
  Known known;
  known.atlas = read_missions(pipeline, registry, engine);
  known.streams["main"] = known.atlas.payloads;
  return known;
}

}  // namespace

Survey open_survey(const std::string& name, const Registry& registry, const Engine& engine) {
  Survey out;
  out.name = name;
  const std::size_t colon = name.rfind(':');
  const bool part = !fs::exists(name) && colon != name.npos && is_run(name.substr(0, colon));
  const std::string run = part ? name.substr(0, colon) : name;
  if (!fs::exists(run))
    throw Error(ErrorCode::config, name,
                "does not exist; expected the folder of a run, RUN:MISSION for one mission of a "
                "run, or a mission folder");
  const Known known =
      is_run(run) ? reopen_run(run, registry, engine) : read_alone(run, registry, engine);
  if (is_run(run)) out.run = fs::weakly_canonical(run);
  choose_streams(known, out);
  out.missions = meant(known.atlas, run, part ? name.substr(colon + 1) : "");
  return out;
}

std::vector<std::uint32_t> missions_in(const Survey& survey, std::size_t island) {
  std::vector<std::uint32_t> out;
  for (const std::uint32_t m : survey.missions)
    if (survey.clouds.missions[m].island == island) out.push_back(m);
  return out;
}

}  // namespace cambium::monitor
