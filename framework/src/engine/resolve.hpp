// SPDX-License-Identifier: BSD-3-Clause
// A pipeline whose plugins are found, whose parameters are bound and whose wiring is checked.
#pragma once
#include <map>
#include <memory>

#include "cambium/plugin.hpp"
#include "pipeline/pipeline.hpp"

namespace cambium {

/// A component with its parameters.
struct Configured {
  std::shared_ptr<const Component> component;
  std::string params;  ///< canonical
  Digest key;          ///< build of the plugin, name and parameters: its part of a cache key

  template <class T>
  const T& as() const {
    return dynamic_cast<const T&>(*component);
  }
};

struct Step {
  const Verb* verb = nullptr;
  StepKeys keys;
  std::string plugin, where;
  const Registered* registered = nullptr;
  Configured configured;
  std::map<int, Configured> by_platform;

  const Configured& for_platform(int platform_id) const;
  /// For a pair of missions: the override of the target's platform, else that of the source's.
  const Configured& for_pair(int target_platform, int source_platform) const;
  std::string title() const { return verb->word + " " + plugin; }
};

struct ResolvedPipeline {
  Pipeline spec;
  std::vector<Step> steps;
};

/// Finds the components in the registry. Throws Error(config) with every mistake.
ResolvedPipeline resolve(const Pipeline& pipeline, const Registry& registry);

/// A component of that kind and name with `params` bound; mistakes go to `diagnostics` (then null).
std::optional<Configured> configure(const Registry& registry, Kind kind, const std::string& name,
                                    const std::string& name_where, const Yaml& params,
                                    Diagnostics& diagnostics);

/// The pipeline with every default written out; running it gives the same result.
std::string to_yaml(const ResolvedPipeline& pipeline);

}  // namespace cambium
