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

/// Reads `<reference>/<mission>.tum`, else `<reference>/<mission>/ground_truth.tum`; with an empty
/// `reference`, `ground_truth.tum` in each mission's folder. A node takes the pose whose stamp is
/// nearest, at most `max_time_difference` [s] away. Throws Error(data) on a malformed file; a
/// mission without a file has no true poses.
Truth read_truth(const Atlas& atlas, const std::filesystem::path& reference,
                 double max_time_difference);

}  // namespace cambium
