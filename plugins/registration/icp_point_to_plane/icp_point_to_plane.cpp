// SPDX-License-Identifier: BSD-3-Clause
// Point-to-plane ICP (Chen, Medioni 1992) on pcl::IterativeClosestPointWithNormals.
#include <pcl/registration/icp.h>
#include <pcl/registration/transformation_estimation_point_to_plane_lls.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "common/coarse_to_fine.hpp"
#include "common/pcl.hpp"

namespace cambium::registration {
namespace {

// PCL's own step inverts the normal equations, which on a plane are singular: the step is NaN, and
// the search tree asserts on it. Here directions that nothing holds stay where they are.
class DampedStep final
    : public pcl::registration::TransformationEstimationPointToPlaneLLS<Point, Point> {
 public:
  void estimateRigidTransformation(const Points& source, const Points& target,
                                   const pcl::Correspondences& correspondences,
                                   Eigen::Matrix4f& T) const override {
    using Vector6 = Eigen::Matrix<double, 6, 1>;
    Eigen::Matrix<double, 6, 6> H = Eigen::Matrix<double, 6, 6>::Zero();
    Vector6 b = Vector6::Zero();
    for (const auto& c : correspondences) {
      const Eigen::Vector3d p = at(source, c.index_query), q = at(target, c.index_match);
      const Eigen::Vector3d n =
          target[std::size_t(c.index_match)].getNormalVector3fMap().cast<double>();
      Vector6 J;
      J << n, p.cross(n);
      H += J * J.transpose();
      b += J * n.dot(q - p);
    }
    H.diagonal().array() += 1e-9 * H.trace() + 1e-12;
    T = to_matrix(SE3::exp(Vec6(H.ldlt().solve(b))));
  }

 private:
  static Eigen::Vector3d at(const Points& points, int i) {
    return points[std::size_t(i)].getVector3fMap().cast<double>();
  }
};

class IcpPointToPlane final : public CoarseToFine {
 public:
  void params(ParamVisitor& v) override {
    CoarseToFine::params(v);
    correspondence_params(v);
  }

 private:
  std::optional<SE3> refine(const Level& target, const Level& source, const SE3& guess,
                            const Stage& stage) const override {
    pcl::IterativeClosestPointWithNormals<Point, Point> icp;
    icp.setTransformationEstimation(std::make_shared<DampedStep>());
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
};

}  // namespace
}  // namespace cambium::registration

CAMBIUM_PLUGIN("icp_point_to_plane", "0.1.0") {
  cambium::registration::silence_pcl();
  registry.add<cambium::registration::IcpPointToPlane>(
      "icp_point_to_plane", "Point-to-plane ICP, coarse to fine, after a search for the start");
}
