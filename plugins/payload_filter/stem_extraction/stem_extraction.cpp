// SPDX-License-Identifier: BSD-3-Clause
// Finds the stems of trees in a cloud: payload `trees` beside, or instead of, the cloud.
#include <cmath>

#include "cambium/plugin.hpp"
#include "common/surface.hpp"
#include "trees.hpp"

namespace stem_extraction {

using namespace cambium;

class StemExtraction final : public PayloadFilter {
 public:
  void params(ParamVisitor& v) override {
    auto& [ground, candidates, fit, min_height, min_score] = limits_;
    v("max_range", candidates.range, "Stems farther from the node are not looked for",
      between(1.0, 200.0, "m"));
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
      "Share of these layers in which its surface stands upright", between(0.0, 1.0));
    v("min_dbh", fit.min_dbh, "Thinner stems are not reported", between(0.02, 2.0, "m"));
    v("max_dbh", fit.max_dbh, "Thicker stems are not reported", between(0.05, 3.0, "m"));
    v("max_lean", fit.max_lean, "Of a stem from the vertical", between(0.01, 1.0, "rad"));
    v("min_points", fit.min_points, "On a stem, between 0.5 and 3 m above the ground",
      between(5, 100000));
    v("min_height", min_height, "What cannot be followed so high is a snag, a shrub or a pole",
      between(0.75, 7.0, "m"));
    v("min_score", min_score, "Stems with a lower score are not reported", between(0.0, 1.0));
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
    const Quat q_level_base = mission.mission().nodes[node].T_mission_node.q;
    auto trees = std::make_shared<std::vector<Tree>>();
    for (const Found& f : find(levelled(*payload.cloud, q_level_base), context))
      trees->push_back(tree_of(f, q_level_base.conjugate()));
    payload.trees = std::move(trees);
    if (!keep_cloud_) payload.cloud = nullptr;
    return payload;
  }

 private:
  // The points near enough, turned so that z is up.
  Cloud levelled(const Cloud& cloud, const Quat& q_level_base) const {
    const Eigen::Matrix3f R = q_level_base.toRotationMatrix().cast<float>();
    const float range = float(limits_.candidates.range);
    Cloud out;
    for (Eigen::Index i = 0; i < cloud.points().cols(); ++i) {
      const Eigen::Vector3f p = R * cloud.points().col(i);
      if (!(p.cwiseAbs().maxCoeff() < 1e4f) || !(p.head<2>().cwiseAbs().maxCoeff() < range))
        continue;
      out.xyz.insert(out.xyz.end(), p.data(), p.data() + 3);
    }
    return out;
  }

  std::vector<Found> find(const Cloud& cloud, const Context& context) const {
    std::vector<Eigen::Vector3f> points;
    for (Eigen::Index i = 0; i < cloud.points().cols(); ++i)
      points.emplace_back(cloud.points().col(i));
    const Ground ground(points, limits_.candidates.range, limits_.ground);
    Cloud low;
    std::vector<Above> above;
    for (const Eigen::Vector3f& p : points) {
      const float height = p.z() - ground.height(p.x(), p.y());
      if (!(height > 0.2f && height < 7.5f)) continue;  // also where there is no ground
      above.push_back({p, height, false});
      low.xyz.insert(low.xyz.end(), p.data(), p.data() + 3);
    }
    context.check_cancelled();
    const filter::Shapes shapes(low, surface_radius_);
    for (std::size_t i = 0; i < above.size(); ++i) above[i].upright = stands(shapes[i]);
    context.check_cancelled();
    return find_trees(std::move(above), ground, limits_, context.seed());
  }

  static bool stands(const filter::Shape& shape) {
    constexpr int fewest = 5;
    constexpr float scattered = 0.15f, level = 0.35f;  // 20 degrees off the vertical
    return shape.points >= fewest && shape.variation < scattered &&
           std::abs(shape.normal.z()) < level && shape.direction.z() * shape.direction.z() > 0.2f;
  }

  static Tree tree_of(const Found& f, const Quat& q_base_level) {
    Tree tree;
    tree.base = q_base_level * f.base();
    tree.axis = q_base_level * f.stem.axis();
    tree.dbh = 2 * f.stem.radius;
    tree.score = f.judgement.score;
    tree.reconstructed = true;
    return tree;
  }

  Limits limits_;
  double surface_radius_ = 0.2;
  bool keep_cloud_ = true;
};

}  // namespace stem_extraction

CAMBIUM_PLUGIN("stem_extraction", "0.1.0") {
  registry.add<stem_extraction::StemExtraction>(
      "stem_extraction", "Finds the stems of trees in a cloud: base, axis, diameter, score");
}
