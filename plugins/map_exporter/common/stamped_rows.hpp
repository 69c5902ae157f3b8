// SPDX-License-Identifier: BSD-3-Clause
// A mission's poses for tables whose rows have a stamp.
#pragma once
#include <string>
#include <vector>

#include "cambium/context.hpp"
#include "cambium/fused.hpp"

namespace cambium::map_export {

/// The trajectory; warns of the nodes for which `table` ("the TUM file") has no row.
inline std::vector<StampedPose> stamped_rows(const MissionState& state, const std::string& table,
                                             const Context& context) {
  std::vector<StampedPose> poses = trajectory(state);
  const std::size_t without = state.mission->nodes.size() - poses.size();
  if (without > 0)
    context.warn(state.mission->name + ": " + std::to_string(without) +
                 " nodes have no stamp, so " + table + " has no row for them");
  return poses;
}

}  // namespace cambium::map_export
