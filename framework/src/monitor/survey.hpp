// SPDX-License-Identifier: BSD-3-Clause
// What a user may look up or compare: a run, one mission of a run, or a mission by itself.
#pragma once
#include "engine/steps.hpp"

namespace cambium::monitor {

/// Missions in the maps that they are in, with what their nodes saw.
struct Survey {
  std::string name;           ///< as the user wrote it
  std::filesystem::path run;  ///< of a run; empty for a mission by itself
  Atlas clouds;               ///< payloads: the run's main stream, which has the clouds
  Atlas trees;  ///< the same map with the stream that has tree tables: main, else the first
  bool has_trees = false;
  std::vector<std::uint32_t> missions;  ///< those meant, ascending
};

/// `name` is the folder of a run, RUN:MISSION, a mission folder or a .g2o file. Throws
/// Error(config) when it is none of them or the run has no such mission, Error(data) when it cannot
/// be read.
Survey open_survey(const std::string& name, const Registry& registry, const Engine& engine);

/// The missions of `survey` that are in this island.
std::vector<std::uint32_t> missions_in(const Survey& survey, std::size_t island);

}  // namespace cambium::monitor
