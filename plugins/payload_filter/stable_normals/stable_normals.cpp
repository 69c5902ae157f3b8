// SPDX-License-Identifier: BSD-3-Clause
// Keeps the points on stable surfaces (ground, trunks) and gives them normals.
#include <cmath>

#include "cambium/plugin.hpp"
#include "common/surface.hpp"

namespace {

using namespace cambium;
using Eigen::Vector3f;
using filter::Shape;

class StableNormals final : public PayloadFilter {
 public:
  void params(ParamVisitor& v) override {
    v("radius", radius_, "Of the smaller neighbourhood", between(0.01, 10.0, "m"));
    v("scale", scale_, "The larger neighbourhood's radius over that of the smaller",
      between(1.1, 10.0));
    v("min_points", min_points_, "In the smaller neighbourhood; sparser points are dropped",
      between(3, 100000));
    v("max_angle", max_angle_, "Between the normals, or lines, of the two neighbourhoods",
      between(0.0, 1.58, "rad"));
    v("max_variation", max_variation_,
      "Share of the variance across the surface in both neighbourhoods; 0 flat, 1/3 a ball",
      between(0.0, 0.34));
    v("min_linearity", min_linearity_,
      "From here on a neighbourhood is a line, as of a thin stem: (l2 - l1) / l2",
      between(0.0, 1.0));
    v("max_lean", max_lean_, "Lines that lean more are branches, or rings of a sparse scan",
      between(0.0, 1.58, "rad"));
    v("normals", normals_,
      "Give the kept points normals: outwards from lines, else towards the origin");
  }

  bool uses_neighbours() const override { return true; }  // gravity is taken from the pose

  Payload apply(const MissionView& mission, std::size_t node,
                const Context& context) const override {
    Payload payload = mission.payload(node);
    if (!payload.cloud) return payload;
    context.check_cancelled();
    const Quat q_base_level = mission.mission().nodes[node].T_mission_node.q.conjugate();
    const Vector3f up = (q_base_level * Vec3::UnitZ()).cast<float>();
    const filter::Shapes small(*payload.cloud, radius_), large(*payload.cloud, radius_ * scale_);
    std::vector<std::size_t> kept;
    std::vector<float> normals;
    for (std::size_t i = 0; i < payload.cloud->size(); ++i) {
      const Vector3f p = payload.cloud->points().col(Eigen::Index(i));
      const Vector3f n = normal(p, small[i], large[i], up);
      if (n.isZero()) continue;
      kept.push_back(i);
      normals.insert(normals.end(), n.data(), n.data() + 3);
    }
    auto out = std::make_shared<Cloud>(select(*payload.cloud, kept));
    if (normals_) out->normals = std::move(normals);
    payload.cloud = std::move(out);
    return payload;
  }

 private:
  /// Unit length; zero for a point whose surface is not stable.
  Vector3f normal(const Vector3f& p, const Shape& small, const Shape& large,
                  const Vector3f& up) const {
    const Vector3f none = Vector3f::Zero();
    const float angle = std::cos(float(max_angle_));
    if (small.points < min_points_) return none;
    if (small.linearity >= min_linearity_) {
      if (std::abs(small.direction.dot(up)) < std::cos(float(max_lean_))) return none;
      if (std::abs(small.direction.dot(large.direction)) < angle) return none;
      // The normals of a line point to all sides: that of a point is its direction from the line.
      const Vector3f d = p - small.mean, off = d - d.dot(small.direction) * small.direction;
      return off.squaredNorm() > 0 ? Vector3f(off.normalized()) : small.normal;
    }
    if (small.variation > max_variation_ || large.variation > max_variation_) return none;
    if (std::abs(small.normal.dot(large.normal)) < angle) return none;
    return small.normal.dot(p) > 0 ? Vector3f(-small.normal) : small.normal;
  }

  double radius_ = 0.2;
  double scale_ = 1.5;
  int min_points_ = 6;
  double max_angle_ = 0.35;
  double max_variation_ = 0.1;
  double min_linearity_ = 0.8;
  double max_lean_ = 0.35;
  bool normals_ = true;
};

}  // namespace

CAMBIUM_PLUGIN("stable_normals", "0.1.0") {
  registry.add<StableNormals>("stable_normals",
                              "Keeps the points with stable normals: ground and trunks");
}
