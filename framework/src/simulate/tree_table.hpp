// SPDX-License-Identifier: BSD-3-Clause
// What an online tree detector reports at a node. A statistical model of the tables of a real
// mission in a boreal forest: about 104 detections a node, 53 of them reconstructed stems; those
// are found again from other nodes in 95 to 99 cases of 100, the others in 64 to 87.
#pragma once
#include "simulate/loops.hpp"
#include "simulate/random.hpp"

namespace cambium::simulate {

struct TreeTable {
  std::vector<Tree> trees;  ///< in the base frame, in random order
  Footprint stems;          ///< marks of the true stems among them, ascending
};

/// `node` is the stream of this node; whether a stem is easy or hard to detect is a property of the
/// stem, the same for every node and mission.
TreeTable detect(const TreesSpec& spec, const SE3& T_world_base, const std::vector<Stem>& stems,
                 const std::vector<Stem>& clutter, const Terrain& terrain, const Random& node);

}  // namespace cambium::simulate
