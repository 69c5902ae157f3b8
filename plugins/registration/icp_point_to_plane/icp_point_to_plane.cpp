// SPDX-License-Identifier: BSD-3-Clause
// Point-to-plane ICP (Chen, Medioni 1992) on pcl::IterativeClosestPointWithNormals.
#include <pcl/registration/icp.h>

#include <cmath>

#include "common/coarse_to_fine.hpp"
#include "common/pcl.hpp"

namespace cambium::registration {
namespace {

class IcpPointToPlane final : public CoarseToFine {
 public:
  void params(ParamVisitor& v) override {
    CoarseToFine::params(v);
    correspondence_params(v);
    v("symmetric", symmetric_, "Use the normals of both clouds: a wider basin on curved surfaces");
  }

 private:
  std::optional<SE3> refine(const Level& target, const Level& source, const SE3& guess,
                            const Stage& stage) const override {
    pcl::IterativeClosestPointWithNormals<Point, Point> icp;
    icp.setUseSymmetricObjective(symmetric_);
    icp.setSearchMethodTarget(target.surface.tree, true);
    icp.setSearchMethodSource(source.surface.tree, true);  // not used, and so not built
    icp.setInputTarget(target.surface.points);
    icp.setInputSource(source.sample);
    icp.setMaxCorrespondenceDistance(stage.max_correspondence_distance);
    icp.setMaximumIterations(stage.max_iterations);
    // PCL compares the squared step, and the cosine of the angle.
    icp.setTransformationEpsilon(stage.translation_epsilon * stage.translation_epsilon);
    icp.setTransformationRotationEpsilon(std::cos(stage.rotation_epsilon));
    Points moved;
    icp.align(moved, to_matrix(guess));
    if (!icp.hasConverged()) return std::nullopt;
    return to_se3(icp.getFinalTransformation());
  }

  bool symmetric_ = false;
};

}  // namespace
}  // namespace cambium::registration

CAMBIUM_PLUGIN("icp_point_to_plane", "0.1.0") {
  cambium::registration::silence_pcl();
  registry.add<cambium::registration::IcpPointToPlane>(
      "icp_point_to_plane", "Point-to-plane ICP, coarse to fine, after a search for the start");
}
