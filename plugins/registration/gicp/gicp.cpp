// SPDX-License-Identifier: BSD-3-Clause
// Generalized-ICP (Segal, Haehnel, Thrun, RSS 2009) on pcl::GeneralizedIterativeClosestPoint.
#include <pcl/registration/gicp.h>

#include "common/coarse_to_fine.hpp"
#include "common/pcl.hpp"

namespace cambium::registration {
namespace {

using Pcl = pcl::GeneralizedIterativeClosestPoint<Point, Point>;

class Gicp final : public CoarseToFine {
 public:
  void params(ParamVisitor& v) override {
    CoarseToFine::params(v);
    correspondence_params(v);
    v("plane_thickness", plane_thickness_,
      "Variance across a surface, where that along it is 1; larger is nearer to point-to-point",
      between(1e-6, 1.0));
  }

 private:
  struct Covariances {
    Pcl::MatricesVectorPtr target, source;  ///< of all points, of the sample
  };

  /// C = I - (1 - thickness) n n': the paper's disc, from the normal that is there already.
  Pcl::MatricesVectorPtr covariances(const Points& points) const {
    auto result = std::make_shared<Pcl::MatricesVector>();
    result->reserve(points.size());
    for (const Point& p : points) {
      const Eigen::Vector3d n = p.getNormalVector3fMap().cast<double>();
      result->push_back(Eigen::Matrix3d::Identity() - (1 - plane_thickness_) * n * n.transpose());
    }
    return result;
  }

  void extend(Level& level, double) const override {
    level.extra = std::make_shared<const Covariances>(
        Covariances{covariances(*level.surface.points), covariances(*level.sample)});
    level.extra_bytes = (level.surface.size() + level.sample->size()) * sizeof(Eigen::Matrix3d);
  }

  std::optional<SE3> refine(const Level& target, const Level& source, const SE3& guess,
                            const Stage& stage) const override {
    Pcl gicp;
    gicp.setSearchMethodTarget(target.surface.tree, true);
    gicp.setSearchMethodSource(source.surface.tree, true);  // not used, and so not built
    gicp.setInputTarget(target.surface.points);
    gicp.setInputSource(source.sample);
    // After the clouds: setting those forgets the covariances.
    gicp.setTargetCovariances(static_cast<const Covariances*>(target.extra.get())->target);
    gicp.setSourceCovariances(static_cast<const Covariances*>(source.extra.get())->source);
    gicp.setMaxCorrespondenceDistance(stage.max_correspondence_distance);
    gicp.setMaximumIterations(stage.max_iterations);
    gicp.setTransformationEpsilon(stage.translation_epsilon);
    gicp.setRotationEpsilon(stage.rotation_epsilon);
    Points moved;
    gicp.align(moved, to_matrix(guess));
    if (!gicp.hasConverged()) return std::nullopt;
    return to_se3(gicp.getFinalTransformation());
  }

  double plane_thickness_ = 0.001;
};

}  // namespace
}  // namespace cambium::registration

CAMBIUM_PLUGIN("gicp", "0.1.0") {
  cambium::registration::silence_pcl();
  registry.add<cambium::registration::Gicp>(
      "gicp", "Generalized-ICP, coarse to fine, after a search for the start");
}
