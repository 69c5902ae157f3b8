// SPDX-License-Identifier: BSD-3-Clause
// Finds the stems of trees in a cloud: payload `trees` beside, or instead of, the cloud.
#include <cmath>

#include "cambium/plugin.hpp"
#include "common/neighbours.hpp"
#include "common/surface.hpp"
#include "views.hpp"

namespace stem_extraction {

using namespace cambium;

class StemExtraction final : public PayloadFilter {
 public:
  void params(ParamVisitor& v) override {
    auto& [ground, candidates, fit, min_height, min_score] = limits_;
    v("max_range", candidates.range, "Stems farther from the node are not looked for",
      between(1.0, 200.0, "m"));
    v("join_radius", join_radius_,
      "Joins the clouds up to so far along the path and aligns them on the stems; 0: one cloud",
      between(0.0, 1000.0, "m"));
    v("join_spacing", join_spacing_,
      "Nodes nearer along the path to one that is joined are left out", between(0.0, 1000.0, "m"));
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
    const Mission& m = mission.mission();
    Views views;
    std::vector<Point> points;
    for (const std::size_t i : filter::neighbours(m, node, join_radius_, join_spacing_)) {
      const auto cloud = i == node ? payload.cloud : mission.payload(i).cloud;
      if (!cloud) continue;
      if (i == node) views.own = views.all.size();
      // Levelled: the axes of the mission, the origin at the node.
      const SE3 T_level_i{m.nodes[i].T_mission_node.q,
                          m.nodes[i].T_mission_node.t - m.nodes[node].T_mission_node.t};
      append(*cloud, T_level_i, std::uint16_t(views.all.size()), points);
      views.all.push_back({T_level_i.t.head<2>()});
      context.check_cancelled();
    }
    auto trees = std::make_shared<std::vector<Tree>>();
    for (const Found& f : find(points, views, context))
      trees->push_back(tree_of(f, m.nodes[node].T_mission_node.q.conjugate()));
    payload.trees = std::move(trees);
    if (!keep_cloud_) payload.cloud = nullptr;
    return payload;
  }

 private:
  struct Point {
    Eigen::Vector3f position;
    std::uint16_t view;
  };
  struct Views {
    std::vector<View> all;
    std::size_t own = 0;
  };

  void append(const Cloud& cloud, const SE3& T_level_base, std::uint16_t view,
              std::vector<Point>& points) const {
    const Eigen::Matrix3f R = T_level_base.rotation().cast<float>();
    const Eigen::Vector3f t = T_level_base.t.cast<float>();
    const float range = float(limits_.candidates.range);
    for (Eigen::Index i = 0; i < cloud.points().cols(); ++i) {
      const Eigen::Vector3f p = R * cloud.points().col(i) + t;
      // Written so that NaN fails.
      if (p.head<2>().cwiseAbs().maxCoeff() < range && std::abs(p.z()) < 1e4f)
        points.push_back({p, view});
    }
  }

  std::vector<Found> find(const std::vector<Point>& points, Views& views,
                          const Context& context) const {
    std::vector<Eigen::Vector3f> positions;
    for (const Point& p : points) positions.push_back(p.position);
    const Ground ground(positions, limits_.candidates.range, limits_.ground);
    Cloud low;
    std::vector<Above> above;
    for (const auto& [p, view] : points) {
      const float height = p.z() - ground.height(p.x(), p.y());
      if (!(height > 0.2f && height < 7.5f)) continue;  // also where there is no ground
      above.push_back({p, height, false, view});
      low.xyz.insert(low.xyz.end(), p.data(), p.data() + 3);
    }
    const filter::Shapes shapes(low, surface_radius_);
    for (std::size_t i = 0; i < above.size(); ++i) above[i].upright = stands(shapes[i]);
    context.check_cancelled();
    std::vector<Found> found = find_trees(above, ground, limits_, context.seed());
    if (views.all.size() < 2) return found;
    align_views(views.all, views.own, limits_.fit, found, above);
    return fitted_again(found, above, limits_);
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
  double join_radius_ = 0.0;
  double join_spacing_ = 0.5;
  double surface_radius_ = 0.2;
  bool keep_cloud_ = true;
};

}  // namespace stem_extraction

CAMBIUM_PLUGIN("stem_extraction", "0.1.0") {
  registry.add<stem_extraction::StemExtraction>(
      "stem_extraction", "Finds the stems of trees in a cloud: base, axis, diameter, score");
}
