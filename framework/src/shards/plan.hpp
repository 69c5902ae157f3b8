// SPDX-License-Identifier: BSD-3-Clause
// A run cut into pieces for several machines. A shard computes its part of a wave into a cache; the
// merge is the ordinary run, which finds everything there. So the result cannot depend on how the
// work was cut, in which order shards ran, or whether one ran twice or not at all.
#pragma once
#include <filesystem>

#include "engine/report.hpp"
#include "engine/share.hpp"

namespace cambium::shards {

struct Pair {
  std::string query, reference;  ///< missions; the same for loops within one
  double cost = 0;               ///< estimate, in registrations
};

struct Plan {
  std::string pipeline;  ///< as in resolved.yaml: every default, missions by absolute path
  std::string program;   ///< digest of the build; another one would fill the cache for nothing
  std::size_t waves = 0;
  std::vector<Pair> pairs;  ///< by query, then reference
};

/// Reads the missions to know what there is to compare. `pipeline` names them.
Plan make_plan(const ResolvedPipeline& pipeline, const Registry& registry, const Engine& engine);

Json to_json(const Plan& plan);
/// Throws Error(config) when it is no plan, or that of another build.
Plan read_plan(const std::filesystem::path& file);

/// The pipeline of the plan, its plugins found.
ResolvedPipeline pipeline_of(const Plan& plan, const std::filesystem::path& file,
                             const Registry& registry);

/// The `index`-th of `count` shards (from 1): disjoint, together everything, about equally costly.
std::vector<SharePart> shard(const Plan& plan, std::size_t index, std::size_t count);

}  // namespace cambium::shards
