// SPDX-License-Identifier: BSD-3-Clause
// A pipeline as the user wrote it: structure checked, plugins not yet looked up.
#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "cambium/kinds.hpp"
#include "pipeline/verbs.hpp"
#include "pipeline/yaml.hpp"

namespace cambium {

struct StepSpec {
  const Verb* verb = nullptr;
  std::string plugin;
  std::string where, plugin_where;  ///< file:line:col
  Yaml params;
  std::map<int, Yaml> platform_params;  ///< by PLATFORM_ID, on top of params
  StepKeys keys;                        ///< the engine's own keys of the step
};

struct MissionSpec {
  std::string path;    ///< folder, file or glob
  std::string name;    ///< empty = as the reader says
  std::string reader;  ///< empty = the one that accepts the path
  Yaml params;
  std::string where;
};

struct Pipeline {
  std::filesystem::path file;
  std::uint64_t seed = 1;
  std::vector<MissionSpec> missions;
  std::vector<StepSpec> steps;
};

/// Reads a pipeline, follows `extends`, applies its `set:` and then `overrides`
/// ("optimize.loss=huber", "recognize[2].radius=5"). Paths of missions become absolute, relative to
/// the file that names them. Throws Error(config) with every mistake.
Pipeline load_pipeline(const std::filesystem::path& file,
                       const std::vector<std::string>& overrides = {});

/// The same from a text that is already in memory; `file` names it and is where paths start from.
Pipeline parse_pipeline(const std::string& text, const std::filesystem::path& file,
                        const std::vector<std::string>& overrides = {});

}  // namespace cambium
