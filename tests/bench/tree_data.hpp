// SPDX-License-Identifier: BSD-3-Clause
// Real tree tables with true poses, for bench_trees.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "support/plain_context.hpp"
#include "support/support.hpp"

namespace cambium::bench {

struct TreeMission {
  Mission mission;
  std::vector<SE3> truth;    ///< T_world_node, one world for the missions of a set
  std::vector<double> path;  ///< distance travelled at each node [m]
  Fingerprints fingerprints;
  std::shared_ptr<const void> files;  ///< keeps a temporary folder
};

/// The missions of an archive, described. Empty when the data is not there.
std::vector<TreeMission> tree_missions(const std::string& archive,
                                       const PlaceRecognizer& recognizer);
/// A made-up stand of 260 x 120 m and five missions through it, parallel at 0, 7, 12, 17 and 22 m,
/// every other one the other way round. `seed` names the forest.
std::vector<TreeMission> simulated_missions(int seed, const PlaceRecognizer& recognizer);
/// The mission cut into missions of `nodes` nodes, each described for itself.
std::vector<TreeMission> pieces(const TreeMission& whole, std::size_t nodes,
                                const PlaceRecognizer& recognizer);
/// The same missions with their truth moved by `distance` [m]: for sets from different forests.
std::vector<TreeMission> far_from(std::vector<TreeMission> missions, double distance);

/// Measures the processor time of each item of parallel_for, on one thread.
class StopWatch final : public testing::PlainContext {
 public:
  void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body) const override;
  mutable std::vector<double> milliseconds;
};

}  // namespace cambium::bench
