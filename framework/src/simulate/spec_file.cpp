// SPDX-License-Identifier: BSD-3-Clause
#include "simulate/spec_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "cambium/files.hpp"
#include "pipeline/binder.hpp"
#include "pipeline/params.hpp"

namespace cambium::simulate {
namespace {

using Json = nlohmann::ordered_json;
struct Section {
  const char* name;
  Component* component;
};

// The sections of a mission may also stand at the top level: there they hold for all missions.
std::vector<Section> mission_sections(MissionSpec& m) {
  return {{"path", &m.path},
          {"sensor", &m.sensor},
          {"camera", &m.camera},
          {"odometry", &m.odometry},
          {"gnss", &m.gnss},
          {"trees", &m.trees}};
}
std::vector<Section> world_sections(SimulationSpec& s) {
  return {{"terrain", &s.terrain},
          {"stand", &s.stand},
          {"foliage", &s.foliage},
          {"clutter", &s.clutter},
          {"loops", &s.loops}};
}

class Reader {
 public:
  explicit Reader(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

  SimulationSpec read(const Yaml& doc) {
    SimulationSpec spec;
    MissionSpec shared;
    auto sections = world_sections(spec);
    for (const Section& s : mission_sections(shared)) sections.push_back(s);
    bind(spec, sections, doc, {"version", "missions"});
    const Yaml *version = doc.find("version"), *missions = doc.find("missions");
    if (!version || version->as_int() != 1)
      diagnostics_.add(version ? version->where : doc.where, "expected 'version: 1'");
    if (!missions || !missions->is_list() || missions->list.empty())
      diagnostics_.add(missions ? missions->where : doc.where,
                       "'missions' must be a list of one mission or more");
    else
      for (const Yaml& m : missions->list) read_mission(m, shared, spec);
    return spec;
  }

 private:
  void read_mission(const Yaml& yaml, const MissionSpec& shared, SimulationSpec& spec) {
    MissionSpec m = shared;
    bind(m, mission_sections(m), yaml, {});
    if (!names_.insert(m.name).second)
      diagnostics_.add(yaml.where, fmt::format("a second mission is named '{}'", m.name));
    if (m.start == 0)
      m.start = spec.missions.empty() ? 1'700'000'000 : spec.missions.back().start + 3600;
    spec.missions.push_back(std::move(m));
  }

  // Binds what is a section to its component, the rest to `own`. `also` are keys read elsewhere.
  void bind(Component& own, const std::vector<Section>& sections, const Yaml& yaml,
            const std::vector<std::string>& also) {
    if (!yaml.is_map())
      return diagnostics_.add(yaml.where, "expected a map, found " + yaml.shown());
    std::vector<std::string> known = also;
    for (const Section& s : sections) known.push_back(s.name);
    for (const ParamInfo& p : list_params(own)) known.push_back(p.name);
    Yaml rest = yaml;
    rest.map.clear();
    for (const auto& item : yaml.map) {
      const std::string& key = item.key.scalar;
      const auto section = std::find_if(sections.begin(), sections.end(),
                                        [&](const Section& s) { return key == s.name; });
      if (section != sections.end())
        bind_params(*section->component, item.value, diagnostics_);
      else if (std::find(known.begin(), known.end(), key) == known.end())
        diagnostics_.add(item.key.where,
                         fmt::format("unknown key '{}'{}", key, suggestion(key, known)));
      else if (std::find(also.begin(), also.end(), key) == also.end())
        rest.map.push_back(item);
    }
    bind_params(own, rest, diagnostics_);
  }

  Diagnostics& diagnostics_;
  std::set<std::string> names_;
};

Json schema_with(Component& own, const std::vector<Section>& sections) {
  Json schema = params_schema(own);
  for (const Section& s : sections) schema["properties"][s.name] = params_schema(*s.component);
  return schema;
}

}  // namespace

SimulationSpec parse_spec(const std::string& text, const std::string& file) {
  Diagnostics diagnostics;
  const Yaml doc = parse_yaml(text, file, diagnostics);
  diagnostics.throw_if_any();
  SimulationSpec spec = Reader(diagnostics).read(doc);
  diagnostics.throw_if_any();
  return spec;
}

SimulationSpec load_spec(const std::filesystem::path& file) {
  return parse_spec(read_file(file), file.string());
}

Json spec_schema() {
  SimulationSpec spec;
  MissionSpec mission;
  auto sections = world_sections(spec);
  for (const Section& s : mission_sections(mission)) sections.push_back(s);
  Json schema = schema_with(spec, sections);
  Json item = schema_with(mission, mission_sections(mission));
  item["required"] = {"name"};
  schema["properties"]["version"] = {{"const", 1}};
  schema["properties"]["missions"] = {{"type", "array"}, {"minItems", 1}, {"items", item}};
  schema["required"] = {"version", "missions"};
  Json out{{"$schema", "http://json-schema.org/draft-07/schema#"}, {"title", "Cambium simulation"}};
  out.update(schema);
  return out;
}

}  // namespace cambium::simulate
