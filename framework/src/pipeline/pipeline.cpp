// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/pipeline.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cambium/files.hpp"
#include "pipeline/overrides.hpp"
#include "pipeline/steps.hpp"

namespace cambium {
namespace {

namespace fs = std::filesystem;
const std::vector<std::string> top_keys = {"version",   "extends", "missions", "steps",
                                           "platforms", "seed",    "set"};

class Parser {
 public:
  explicit Parser(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

  /// The document of `file` on top of those that it extends.
  Yaml load(const std::string& text, const fs::path& file, int depth = 0) {
    Yaml doc = parse_yaml(text, file.string(), diagnostics_);
    if (!doc.is_map()) {
      diagnostics_.add(file.string(),
                       "expected a map with 'version' and 'steps', found " + doc.shown());
      return {};
    }
    make_paths_absolute(doc, fs::absolute(file).parent_path());
    const Yaml* base = doc.find("extends");
    if (!base) return doc;
    if (!base->is_scalar() || depth > 8) {
      diagnostics_.add(base->where, depth > 8 ? "extends itself, or more than 8 files deep"
                                              : "'extends' must be a file, found " + base->shown());
      return doc;
    }
    const fs::path base_file = file.parent_path() / base->scalar;
    return over_base(load(read_file(base_file), base_file, depth + 1), doc);
  }

  Pipeline read(const Yaml& doc) {
    Pipeline p;
    check_keys(doc, top_keys, "the pipeline", diagnostics_);
    check_version(doc);
    if (const Yaml* seed = doc.find("seed")) read_seed(*seed, p);
    if (const Yaml* missions = doc.find("missions"))
      for (const Yaml& m : items(*missions, "missions")) read_mission(m, p);
    if (const Yaml* steps = doc.find("steps")) {
      for (const Yaml& s : items(*steps, "steps"))
        if (auto step = parse_step(s, diagnostics_)) p.steps.push_back(std::move(*step));
    } else {
      diagnostics_.add(doc.where, "'steps' is missing; expected a list such as '- optimize: ...'");
    }
    if (const Yaml* platforms = doc.find("platforms")) parse_platforms(*platforms, p, diagnostics_);
    return p;
  }

  /// `set:` of the file: the same as overrides on the command line, with a place in the file.
  void read_set(const Yaml& doc, Pipeline& p) {
    const Yaml* set = doc.find("set");
    if (!set) return;
    if (!set->is_map()) {
      diagnostics_.add(set->where,
                       "'set' must be a map such as 'optimize.loss: huber', found " + set->shown());
      return;
    }
    for (const auto& [key, value] : set->map) apply_override(p, key, value, diagnostics_);
  }

 private:
  static void make_paths_absolute(Yaml& doc, const fs::path& folder) {
    const auto fix = [&](Yaml& y) {
      if (y.is_scalar()) y.scalar = (folder / y.scalar).lexically_normal().string();
    };
    for (auto& item : doc.map) {
      if (item.key.scalar != "missions") continue;
      for (Yaml& m : item.value.list) {
        fix(m);
        for (auto& part : m.map)
          if (part.key.scalar == "path") fix(part.value);
      }
    }
  }

  // The lists are replaced whole; `platforms` and `set` are merged key by key.
  static Yaml over_base(const Yaml& base, const Yaml& doc) {
    Yaml out = merged(base, doc);
    for (const char* key : {"platforms", "set"}) {
      const Yaml *a = base.find(key), *b = doc.find(key);
      if (!a || !b || !a->is_map() || !b->is_map()) continue;
      Yaml name;
      name.type = Yaml::Type::scalar;
      name.scalar = key;
      out.set(name, merged(*a, *b));
    }
    return out;
  }

  void check_version(const Yaml& doc) {
    const Yaml* version = doc.find("version");
    if (!version)
      diagnostics_.add(doc.where, "'version' is missing; expected 'version: 1'");
    else if (version->as_int() != 1)
      diagnostics_.add(version->where, "'version' must be 1, found " + version->shown());
  }

  const std::vector<Yaml>& items(const Yaml& list, const char* name) {
    if (!list.is_list())
      diagnostics_.add(list.where,
                       fmt::format("'{}' must be a list, found {}", name, list.shown()));
    return list.list;
  }

  void read_seed(const Yaml& seed, Pipeline& p) {
    const auto value = seed.as_int();
    if (!value || *value < 0)
      diagnostics_.add(seed.where, "'seed' must be a whole number from 0, found " + seed.shown());
    else
      p.seed = std::uint64_t(*value);
  }

  void read_mission(const Yaml& m, Pipeline& p) {
    MissionSpec spec;
    spec.where = m.where;
    if (m.is_scalar()) spec.path = m.scalar;
    if (m.is_map()) {
      check_keys(m, {"path", "name", "reader", "params"}, "a mission", diagnostics_);
      for (const auto& [key, value] : m.map) {
        if (key.scalar == "params")
          spec.params = value;
        else if (!value.is_scalar())
          diagnostics_.add(value.where,
                           fmt::format("'{}' must be a text, found {}", key.scalar, value.shown()));
        else if (key.scalar == "path")
          spec.path = value.scalar;
        else if (key.scalar == "name")
          spec.name = value.scalar;
        else if (key.scalar == "reader")
          spec.reader = value.scalar;
      }
    }
    if (spec.path.empty())
      diagnostics_.add(m.where,
                       "a mission must be a path or a map with 'path', found " + m.shown());
    else
      p.missions.push_back(std::move(spec));
  }

  Diagnostics& diagnostics_;
};

}  // namespace

Pipeline load_pipeline(const fs::path& file, const std::vector<std::string>& overrides) {
  return parse_pipeline(read_file(file), file, overrides);
}

Pipeline parse_pipeline(const std::string& text, const fs::path& file,
                        const std::vector<std::string>& overrides) {
  Diagnostics diagnostics;
  Parser parser(diagnostics);
  const Yaml doc = parser.load(text, file);
  diagnostics.throw_if_any();  // what follows needs a map
  Pipeline p = parser.read(doc);
  p.file = file;
  parser.read_set(doc, p);
  for (const auto& o : overrides) apply_override(p, o, diagnostics);
  diagnostics.throw_if_any();
  return p;
}

}  // namespace cambium
