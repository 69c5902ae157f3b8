// SPDX-License-Identifier: BSD-3-Clause
// Trees from above: the tops in a cloud become a tree table, with the ground below each as its
// base.
#include <cmath>

#include "cambium/plugin.hpp"
#include "canopy.hpp"

namespace tree_tops {

using namespace cambium;

class TreeTops final : public PayloadFilter {
 public:
  void params(ParamVisitor& v) override {
    v("ground_cell", limits_.ground_cell, "The lowest point in a cell of this width may be ground",
      between(0.2, 50.0, "m"));
    v("max_slope", limits_.max_slope, "Of the ground; what rises faster from it is vegetation",
      between(1.0, 80.0, "deg"));
    v("cell", limits_.cell, "Width of a cell of the canopy's surface", between(0.1, 10.0, "m"));
    v("min_height", limits_.min_height, "Lower tops are no trees", above(0.0, "m"));
    v("crown", limits_.crown, "No higher point lies so near to a top", above(0.0, "m"));
    v("crown_growth", limits_.crown_growth, "Added to it per metre of the tree's height",
      between(0.0, 1.0, "m/m"));
    v("only_above", only_above_,
      "Nodes that have more than 1 % of their cloud above them are on the ground: their payload "
      "stays "
      "as it is");
    v("keep_cloud", keep_cloud_, "False: the payload holds the trees alone");
  }

  Payload apply(const MissionView& mission, std::size_t node,
                const Context& context) const override {
    Payload payload = mission.payload(node);
    if (!payload.cloud) return payload;
    context.check_cancelled();
    // Missions are level: a node's own pose says which way is up for it.
    SE3 T_level_node;
    T_level_node.q = mission.mission().nodes[node].T_mission_node.q;
    const SE3 T_node_level = T_level_node.inverse();
    const Cloud levelled = transformed(T_level_node, *payload.cloud);
    if (only_above_ && !is_above(levelled)) return payload;
    std::vector<Tree> trees;
    for (const Top& top : find_tops(levelled, limits_)) {
      Tree tree;
      tree.base = T_node_level * top.base;
      tree.axis = T_node_level.q * Vec3(Vec3::UnitZ());
      tree.dbh = std::nan("");  // nobody sees a stem from above
      tree.score = 1;
      trees.push_back(tree);
    }
    payload.trees = std::make_shared<const std::vector<Tree>>(std::move(trees));
    if (!keep_cloud_) payload.cloud = nullptr;
    return payload;
  }

 private:
  /// Whether the node, the origin of the cloud, is above nearly all that it sees.
  static bool is_above(const Cloud& levelled) {
    std::size_t higher = 0;
    for (std::size_t i = 2; i < levelled.xyz.size(); i += 3) higher += levelled.xyz[i] > 0;
    return 100 * higher <= levelled.size();
  }

  Limits limits_;
  bool only_above_ = false;
  bool keep_cloud_ = true;
};

}  // namespace tree_tops

CAMBIUM_PLUGIN("tree_tops", "0.1.0") {
  registry.add<tree_tops::TreeTops>("tree_tops",
                                    "Tree tables from the tops in clouds taken from above");
}
