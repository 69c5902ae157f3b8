// SPDX-License-Identifier: BSD-3-Clause
#include "read_one.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "engine/resolve.hpp"
#include "pipeline/params.hpp"

namespace cambium::cli {
namespace {

std::string reader_for(const std::filesystem::path& mission, const Registry& registry) {
  std::vector<std::string> accepting;
  for (const auto& [key, registered] : registry.all()) {
    if (key.first != Kind::mission_reader) continue;
    const auto reader = registered.create();
    if (dynamic_cast<const MissionReader&>(*reader).accepts(mission))
      accepting.push_back(key.second);
  }
  if (accepting.size() == 1) return accepting[0];
  throw Error(accepting.empty() ? ErrorCode::data : ErrorCode::config, mission.string(),
              accepting.empty()
                  ? "no reader knows it; expected a mission folder (with slam_pose_graph.g2o), a "
                    "pose graph (.g2o) or another format that a reader of 'cambium plugins "
                    "list' reads"
                  : fmt::format("more than one reader knows it; name one with --reader: {}",
                                fmt::join(accepting, ", ")));
}

}  // namespace

void set_param(Yaml& params, const std::string& name, const std::string& value,
               const std::string& where) {
  Yaml key, given;
  params.type = Yaml::Type::map;
  key.type = given.type = Yaml::Type::scalar;
  key.scalar = name, given.scalar = value;
  key.where = given.where = where;
  params.set(key, given);
}

void set_if_known(Component& reader, Yaml& params, const std::string& name,
                  const std::string& value) {
  for (const ParamInfo& info : list_params(reader))
    if (info.name == name && !params.find(name)) set_param(params, name, value, "the command");
}

Mission read_one(const WhatToRead& what, const std::function<void(Component&, Yaml&)>& adjust,
                 const Registry& registry, const Engine& engine) {
  if (!std::filesystem::exists(what.path))
    throw Error(ErrorCode::data, what.path.string(), "does not exist");
  const std::string name = what.reader.empty() ? reader_for(what.path, registry) : what.reader;
  const Registered* registered = registry.find(Kind::mission_reader, name);
  Diagnostics diagnostics;
  Yaml params = parse_yaml(what.params, "--params", diagnostics);
  if (registered) adjust(*registered->create(), params);
  const auto reader =
      configure(registry, Kind::mission_reader, name, "--reader", params, diagnostics);
  diagnostics.throw_if_any();
  return reader->as<MissionReader>().read(what.path, *engine.context(Digest{}, 0));
}

}  // namespace cambium::cli
