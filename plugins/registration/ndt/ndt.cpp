// SPDX-License-Identifier: BSD-3-Clause
// Normal distributions transform (Magnusson, thesis 2009) on pcl::NormalDistributionsTransform.
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/registration/ndt.h>

#include <cmath>

#include "common/near_guess.hpp"
#include "pcl.hpp"

namespace cambium::registration {
namespace {

using Point = pcl::PointXYZ;
using Points = pcl::PointCloud<Point>;
using Pcl = pcl::NormalDistributionsTransform<Point, Point>;

Points::Ptr points_of(const Patches& patches) {
  auto points = std::make_shared<Points>();
  for (const Patch& p : patches) points->push_back({p.at.x(), p.at.y(), p.at.z()});
  return points;
}

class Ndt final : public NearGuess {
 public:
  void params(ParamVisitor& v) override {
    NearGuess::params(v);
    v("cell_points", cell_points_,
      "Cell of the distributions as a multiple of the cloud's voxel: about this squared points "
      "each",
      between(2.0, 50.0));
    v("step_size", step_size_, "Longest step of one iteration, in cells of the distributions",
      between(0.01, 10.0));
    v("outlier_ratio", outlier_ratio_, "Share of the source that has no counterpart",
      between(0.01, 0.99));
  }

 private:
  /// An object with its distributions in place. refine() copies it, since PCL keeps the state of a
  /// run in the object; that costs less than a millisecond, building the distributions many.
  void extend(Level& level, double voxel_size) const override {
    auto ndt = std::make_shared<Pcl>();
    // Not used, and so not built.
    ndt->setSearchMethodTarget(std::make_shared<pcl::search::KdTree<Point>>(), true);
    ndt->setResolution(float(cell_points_ * voxel_size));
    ndt->setInputTarget(points_of(level.surface.patches));
    level.extra = ndt;
    level.extra_bytes = level.surface.size() * 80;
  }

  std::optional<SE3> refine(const Level& target, const Level& source, const SE3& guess,
                            const Stage& stage) const override {
    Pcl ndt = *std::static_pointer_cast<const Pcl>(target.extra);
    ndt.setInputSource(points_of(source.sample));
    ndt.setMaximumIterations(stage.max_iterations);
    ndt.setOulierRatio(outlier_ratio_);  // PCL's spelling
    ndt.setStepSize(step_size_ * cell_points_ * stage.voxel_size);
    // PCL compares the squared step, and the cosine of the angle.
    ndt.setTransformationEpsilon(stage.translation_epsilon * stage.translation_epsilon);
    ndt.setTransformationRotationEpsilon(std::cos(stage.rotation_epsilon));
    Points moved;
    ndt.align(moved, to_matrix(guess));
    if (!ndt.hasConverged()) return std::nullopt;
    return to_se3(ndt.getFinalTransformation());
  }

  double cell_points_ = 4.0;
  double step_size_ = 0.5;
  double outlier_ratio_ = 0.55;
};

}  // namespace
}  // namespace cambium::registration

CAMBIUM_PLUGIN("ndt", "0.1.0") {
  cambium::registration::silence_pcl();
  registry.add<cambium::registration::Ndt>(
      "ndt", "Normal distributions transform, coarse to fine, after a search for the start");
}
