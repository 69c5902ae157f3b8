// SPDX-License-Identifier: BSD-3-Clause
#include "engine/missions.hpp"

#include <fmt/format.h>
#include <glob.h>

#include <algorithm>

#include "cambium/dialect.hpp"
#include "engine/copies.hpp"
#include "engine/memory_use.hpp"
#include "engine/mission_checks.hpp"

namespace cambium {
namespace {

namespace fs = std::filesystem;

struct Source {
  fs::path path;
  MissionSpec spec;
  Configured reader;
};

std::vector<fs::path> expand(const MissionSpec& spec, Diagnostics& diagnostics) {
  if (fs::exists(spec.path)) return {spec.path};
  glob_t found{};
  std::vector<fs::path> paths;
  if (::glob(spec.path.c_str(), 0, nullptr, &found) == 0)
    paths.assign(found.gl_pathv, found.gl_pathv + found.gl_pathc);
  ::globfree(&found);
  if (paths.empty())
    diagnostics.add(spec.where, fmt::format("no mission at '{}': no such folder or file, and no "
                                            "match as a glob",
                                            spec.path));
  return paths;
}

std::optional<Configured> find_reader(const Source& source, const Registry& registry,
                                      Diagnostics& diagnostics) {
  const auto& spec = source.spec;
  if (!spec.reader.empty())
    return configure(registry, Kind::mission_reader, spec.reader, spec.where, spec.params,
                     diagnostics);
  std::vector<std::string> accepting, known;
  for (const auto& [key, registered] : registry.all()) {
    if (key.first != Kind::mission_reader) continue;
    known.push_back(key.second);
    const auto reader = registered.create();
    if (dynamic_cast<const MissionReader&>(*reader).accepts(source.path))
      accepting.push_back(key.second);
  }
  if (accepting.size() == 1)
    return configure(registry, Kind::mission_reader, accepting[0], spec.where, spec.params,
                     diagnostics);
  diagnostics.add(spec.where,
                  fmt::format("{} reader accepts '{}'; name one with 'reader:'{}",
                              accepting.empty() ? "no" : "more than one", source.path.string(),
                              suggestion("", accepting.empty() ? known : accepting)));
  return std::nullopt;
}

Atlas make_atlas(std::vector<Mission> missions, const Engine& engine) {
  Atlas atlas;
  auto payloads = std::make_shared<PayloadSources>();
  for (auto& m : missions) {
    auto& sources = payloads->emplace_back();
    for (const Node& n : m.nodes) sources.push_back(stored(n.payload, engine.store()));
    const auto index = std::uint32_t(atlas.missions.size());
    atlas.missions.push_back(initial_state(std::make_shared<const Mission>(std::move(m)), index));
    atlas.islands.push_back({{index}, atlas.missions.back().mission->georeference});
  }
  atlas.payloads = payloads;
  assign_offsets(atlas.missions);
  return atlas;
}

}  // namespace

MissionState initial_state(std::shared_ptr<const Mission> mission, std::uint32_t island) {
  std::vector<SE3> poses;
  for (const Node& n : mission->nodes) poses.push_back(n.T_mission_node);
  return {std::move(mission), std::make_shared<const std::vector<SE3>>(std::move(poses)), island,
          0};
}

void assign_offsets(std::vector<MissionState>& missions) {
  constexpr NodeId stride = 10000;
  NodeId next = 0;
  for (auto& m : missions) {
    const auto& nodes = m.mission->nodes;
    const NodeId low = nodes.front().id, high = nodes.back().id;
    const NodeId shift = low >= 0 && high < 100 * stride ? 0 : low;
    m.id_offset = next - shift;
    next += ((high - shift) / stride + 1) * stride;
  }
}

Atlas read_missions(const Pipeline& pipeline, const Registry& registry, const Engine& engine) {
  Diagnostics diagnostics;
  std::vector<Source> sources;
  for (const auto& spec : pipeline.missions)
    for (const auto& path : expand(spec, diagnostics)) {
      Source source{path, spec, {}};
      if (auto reader = find_reader(source, registry, diagnostics)) {
        source.reader = *reader;
        sources.push_back(std::move(source));
      }
    }
  diagnostics.throw_if_any();
  if (sources.empty())
    throw Error(ErrorCode::config, pipeline.file.string(),
                "no missions; name them under 'missions:' or on the command line");

  std::vector<Mission> missions(sources.size());
  const std::size_t before = resident_bytes();
  engine.progress().begin("read missions");
  engine.progress().expect(sources.size());
  engine.parallel_for(sources.size(), [&](std::size_t i) {
    const auto context = engine.context(digest_bytes(sources[i].path.string()), pipeline.seed);
    missions[i] = sources[i].reader.as<MissionReader>().read(sources[i].path, *context);
    if (!sources[i].spec.name.empty()) {
      missions[i].name = sources[i].spec.name;
      missions[i].digest = mission_digest(missions[i]);  // the name is part of it
    }
    check_mission(missions[i], sources[i].path);
    engine.progress().advance();
  });
  std::stable_sort(missions.begin(), missions.end(),
                   [](const Mission& a, const Mission& b) { return a.name < b.name; });
  check_names(missions);
  refuse_copies(missions);
  std::size_t nodes = 0;
  for (const auto& m : missions) nodes += m.nodes.size();
  engine.progress().end(fmt::format("{} missions, {} nodes", missions.size(), nodes));
  for (const auto& m : missions) warn_of(m, engine.progress());
  Atlas atlas = make_atlas(std::move(missions), engine);
  check_memory(engine, atlas.missions.size(), before);
  return atlas;
}

}  // namespace cambium
