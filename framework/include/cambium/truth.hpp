// SPDX-License-Identifier: BSD-3-Clause
// Ground truth for evaluators: one frame for all missions.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cambium/atlas.hpp"

namespace cambium {

struct Truth {
  /// [mission][node]; nothing where the truth has no pose at that time
  std::vector<std::vector<std::optional<SE3>>> T_world_node;
  std::vector<std::string> files;  ///< [mission], where its truth was looked for
  std::size_t matched = 0;         ///< nodes with a true pose

  const std::optional<SE3>& at(NodeRef n) const { return T_world_node[n.mission][n.node]; }
  void require_matches() const;  ///< throws Error(data) when no node has a true pose
};

/// Where the truth of a mission is looked for: `<reference>/<mission>/ground_truth.tum` if it
/// exists, else `<reference>/<mission>.tum`; with an empty `reference`, `ground_truth.tum` in its
/// folder.
std::filesystem::path truth_file(const Mission& mission, const std::filesystem::path& reference);

/// A node takes the pose whose stamp is nearest, at most `max_time_difference` [s] away. A mission
/// without a file has no true poses. Throws Error(data) on a malformed file.
Truth read_truth(const Atlas& atlas, const std::filesystem::path& reference,
                 double max_time_difference);

}  // namespace cambium
