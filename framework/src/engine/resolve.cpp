// SPDX-License-Identifier: BSD-3-Clause
#include "engine/resolve.hpp"

#include <fmt/format.h>

#include "engine/wiring.hpp"
#include "pipeline/binder.hpp"
#include "pipeline/params.hpp"

namespace cambium {
namespace {

std::vector<std::string> names_of(const Registry& registry, Kind kind) {
  std::vector<std::string> names;
  for (const auto& [key, component] : registry.all())
    if (key.first == kind) names.push_back(key.second);
  return names;
}

// resolved.yaml lies elsewhere than what the user wrote, and must mean the same files: their names
// as they were bound.
void make_files_absolute(Yaml& params, const Configured& bound) {
  const auto canonical = nlohmann::json::parse(bound.params);
  for (Yaml::Item& item : params.map) {
    const auto value = canonical.find(item.key.scalar);
    if (value != canonical.end() && value->is_string()) item.value.scalar = value->get<std::string>();
  }
}

std::optional<Step> resolve_step(StepSpec& spec, const Registry& registry,
                                 Diagnostics& diagnostics) {
  Step step;
  step.verb = spec.verb;
  step.keys = spec.keys;
  step.plugin = spec.plugin;
  step.where = spec.where;
  auto configured = configure(registry, spec.verb->kind, spec.plugin, spec.plugin_where,
                              spec.params, diagnostics);
  if (!configured) return std::nullopt;
  step.registered = registry.find(spec.verb->kind, spec.plugin);
  step.configured = *configured;
  for (auto& [platform, params] : spec.platform_params) {
    auto other = configure(registry, spec.verb->kind, spec.plugin, spec.plugin_where,
                           merged(spec.params, params), diagnostics);
    if (!other) continue;
    make_files_absolute(params, *other);
    step.by_platform[platform] = *other;
  }
  return step;
}

}  // namespace

const Configured& Step::for_platform(int platform_id) const {
  const auto it = by_platform.find(platform_id);
  return it == by_platform.end() ? configured : it->second;
}

const Configured& Step::for_pair(int target_platform, int source_platform) const {
  return by_platform.contains(target_platform) ? for_platform(target_platform)
                                               : for_platform(source_platform);
}

std::optional<Configured> configure(const Registry& registry, Kind kind, const std::string& name,
                                    const std::string& name_where, const Yaml& params,
                                    Diagnostics& diagnostics) {
  const Registered* registered = registry.find(kind, name);
  if (!registered) {
    diagnostics.add(name_where, fmt::format("unknown {} '{}'{}", to_string(kind), name,
                                            suggestion(name, names_of(registry, kind))));
    return std::nullopt;
  }
  const std::shared_ptr<Component> component = registered->create();
  bind_params(*component, params, diagnostics);
  const Digest key = Hasher()
                         .add(registered->build)
                         .add(to_string(kind))
                         .add(name)
                         .add(identifying_params(*component))
                         .digest();
  return Configured{component, canonical_params(*component), key};
}

ResolvedPipeline resolve(const Pipeline& pipeline, const Registry& registry) {
  Diagnostics diagnostics;
  ResolvedPipeline out{pipeline, {}};
  for (MissionSpec& m : out.spec.missions) {
    if (m.reader.empty() || m.params.is_null()) continue;
    if (const auto reader = configure(registry, Kind::mission_reader, m.reader, m.where, m.params,
                                      diagnostics))
      make_files_absolute(m.params, *reader);
  }
  for (auto& spec : out.spec.steps)
    if (auto step = resolve_step(spec, registry, diagnostics))
      out.steps.push_back(std::move(*step));
  check_wiring(pipeline, diagnostics);
  diagnostics.throw_if_any();
  return out;
}

namespace {

std::string missions_yaml(const std::vector<MissionSpec>& missions) {
  if (missions.empty()) return "missions: []\n";
  const auto quoted = [](const std::string& s) { return nlohmann::json(s).dump(); };
  std::string out = "missions:\n";
  for (const MissionSpec& m : missions) {
    out += fmt::format("  - path: {}\n", quoted(m.path));
    if (!m.name.empty()) out += fmt::format("    name: {}\n", quoted(m.name));
    if (!m.reader.empty()) out += fmt::format("    reader: {}\n", m.reader);
    if (!m.params.is_null()) out += fmt::format("    params: {}\n", to_flow(m.params));
  }
  return out;
}

// What a platform overrides, not the whole parameters: those differ between steps of one verb.
std::string platforms_yaml(const std::vector<StepSpec>& steps) {
  std::map<int, std::map<std::string, std::string>> platforms;
  for (const StepSpec& s : steps)
    for (const auto& [id, params] : s.platform_params)
      platforms[id][s.verb->word] = to_flow(params);
  std::string out = platforms.empty() ? "" : "platforms:\n";
  for (const auto& [id, words] : platforms) {
    out += fmt::format("  {}:\n", id);
    for (const auto& [word, params] : words)
      out += fmt::format("    {}: {{params: {}}}\n", word, params);
  }
  return out;
}

}  // namespace

std::string to_yaml(const ResolvedPipeline& p) {
  std::string out =
      fmt::format("version: 1\nseed: {}\n{}steps:\n", p.spec.seed, missions_yaml(p.spec.missions));
  for (const auto& s : p.steps) {
    out += fmt::format("  - {}: {}\n", s.verb->word, s.plugin);
    StepKeys keys = s.keys;
    for (const auto& k : list_params(keys))
      out += fmt::format("    {}: {}\n", k.name, k.value.dump());
    out += fmt::format("    params: {}\n", s.configured.params);
  }
  return out + platforms_yaml(p.spec.steps);
}

}  // namespace cambium
