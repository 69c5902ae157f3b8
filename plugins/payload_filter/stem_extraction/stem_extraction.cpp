// SPDX-License-Identifier: BSD-3-Clause
// Finds the stems of trees in a cloud: payload `trees` beside, or instead of, the cloud.
#include <cmath>

#include "cambium/plugin.hpp"
#include "common/surface.hpp"
#include "scans.hpp"

namespace stem_extraction {

using namespace cambium;

class StemExtraction final : public PayloadFilter {
 public:
  void params(ParamVisitor& v) override {
    auto& [ground, candidates, fit, min_height, min_score] = limits_;
    v("max_range", join_.range, "Stems farther from the node are not looked for",
      between(1.0, 200.0, "m"));
    v("join_radius", join_.radius,
      "Joins scans up to so far along the path, aligned on the stems; 0: the cloud is a submap",
      between(0.0, 1000.0, "m"));
    v("join_spacing", join_.spacing,
      "Nodes nearer along the path to one that is joined are left out", between(0.05, 1000.0, "m"));
    v("ground_cell", ground.cell, "The lowest point of each cell of this width may be ground",
      between(0.1, 10.0, "m"));
    v("max_slope", ground.max_slope, "Of the ground; what is steeper stands on it",
      between(0.05, 1.4, "rad"));
    v("surface_radius", surface_radius_, "Neighbourhood whose shape says whether a surface stands",
      between(0.05, 2.0, "m"));
    v("layer_share", candidates.layer_share,
      "Share of the layers of 0.25 m, from 0.5 to 4 m, in which a candidate has points",
      between(0.0, 1.0));
    v("min_upright", candidates.min_upright,
      "Share of these layers, where its surface is known, in which it stands upright",
      between(0.0, 1.0));
    v("min_dbh", fit.min_dbh, "Thinner stems are not reported", between(0.02, 2.0, "m"));
    v("max_dbh", fit.max_dbh, "Thicker stems are not reported", between(0.05, 3.0, "m"));
    v("max_lean", fit.max_lean, "Of a stem from the vertical", between(0.01, 1.0, "rad"));
    v("min_points", fit.min_points, "On a stem, between 0.5 and 3 m above the ground",
      between(5, 100000));
    v("min_height", min_height, "What cannot be followed so high is a snag, a shrub or a pole",
      between(0.75, 7.0, "m"));
    v("min_score", min_score, "Stems with a lower score are not reported", between(0.0, 1.0));
    v("reconstructed_score", reconstructed_score_,
      "From this score on a stem counts as reconstructed, below as detected only",
      between(0.0, 1.0));
    v("keep_cloud", keep_cloud_, "False: only the trees go on, which takes next to no memory");
  }
  std::string check_params() const override {
    return limits_.fit.min_dbh < limits_.fit.max_dbh ? "" : "min_dbh must be below max_dbh";
  }

  bool uses_neighbours() const override { return true; }  // gravity is taken from the pose

  Payload apply(const MissionView& mission, std::size_t node,
                const Context& context) const override {
    Payload payload = mission.payload(node);
    if (!payload.cloud) return payload;
    context.check_cancelled();
    Scans scans = join(mission, node, *payload.cloud, join_);
    auto trees = std::make_shared<std::vector<Tree>>();
    for (const Found& f : find(scans, context))
      trees->push_back(tree_of(f, mission.mission().nodes[node].T_mission_node.q.conjugate()));
    payload.trees = std::move(trees);
    if (!keep_cloud_) payload.cloud = nullptr;
    return payload;
  }

 private:
  std::vector<Found> find(Scans& scans, const Context& context) const {
    std::vector<Eigen::Vector3f> positions;
    for (const Return& p : scans.points) positions.push_back(p.position);
    const Ground ground(positions, join_.range, limits_.ground);
    Cloud low;
    std::vector<Above> above;
    for (const auto& [p, view] : scans.points) {
      const float height = p.z() - ground.height(p.x(), p.y());
      if (!(height > 0.2f && height < 7.5f)) continue;  // also where there is no ground
      above.push_back({p, height, Surface::unknown, view});
      low.xyz.insert(low.xyz.end(), p.data(), p.data() + 3);
    }
    const filter::Shapes shapes(low, surface_radius_);
    for (std::size_t i = 0; i < above.size(); ++i) above[i].surface = surface(shapes[i]);
    context.check_cancelled();
    std::vector<Found> found = find_trees(above, ground, limits_, context.seed());
    context.check_cancelled();
    // Where a submap comes in, nobody knows where its rays came from.
    if (join_.radius == 0) return found;
    if (scans.views.size() > 1) align_views(scans.views, scans.own, limits_.fit, found, above);
    return fitted_again(found, above, scans.views, limits_);
  }

  static Surface surface(const filter::Shape& shape) {
    constexpr int fewest = 5;
    constexpr float scattered = 0.15f, level = 0.35f, flat = 0.02f, upright = 0.45f;
    if (shape.points < fewest) return Surface::unknown;
    // Above the ground, what is level and thin is a ring of one scan.
    if (shape.variation < flat && std::abs(shape.normal.z()) > 0.9f) return Surface::unknown;
    const bool stands = shape.variation < scattered && std::abs(shape.normal.z()) < level &&
                        std::abs(shape.direction.z()) > upright;
    return stands ? Surface::upright : Surface::other;
  }

  Tree tree_of(const Found& f, const Quat& q_base_level) const {
    Tree tree;
    tree.base = q_base_level * f.base();
    tree.axis = q_base_level * f.stem.axis();
    tree.dbh = 2 * f.stem.radius;
    tree.score = f.judgement.score;
    tree.reconstructed = f.judgement.score >= reconstructed_score_;
    return tree;
  }

  Limits limits_;
  Join join_;
  double surface_radius_ = 0.2;
  double reconstructed_score_ = 0.5;
  bool keep_cloud_ = true;
};

}  // namespace stem_extraction

CAMBIUM_PLUGIN("stem_extraction", "0.1.0") {
  registry.add<stem_extraction::StemExtraction>(
      "stem_extraction", "Finds the stems of trees in a cloud: base, axis, diameter, score");
}
