// SPDX-License-Identifier: BSD-3-Clause
// The factors of cambium/pose_graph.hpp for GTSAM, with exact Jacobians. GTSAM's own BetweenFactor
// measures with the logarithm of SE(3), another cost. A pose moves as GTSAM moves it: T <- T
// Exp(dtheta; dt), both in the node's frame, rotation first. Residuals are rotation first, too, so
// the rows and columns of an information matrix change places.
#pragma once
#include <gtsam/geometry/Pose3.h>
#include <gtsam/nonlinear/NonlinearFactor.h>

#include <optional>

#include "cambium/pose_graph.hpp"
#include "common/loss.hpp"

namespace cambium::gtsam_solver {

gtsam::Pose3 to_gtsam(const SE3& T);
SE3 from_gtsam(const gtsam::Pose3& T);
Mat6 rotation_first(const Mat6& information);  ///< also the way back

/// One of ours as GTSAM's M-estimator; its loss is half of ours, as all of GTSAM's costs are.
gtsam::SharedNoiseModel noise(std::size_t rows, const pose_solver::Loss& loss);

/// A pose that is a variable, or held where it is.
struct End {
  gtsam::Key key = 0;
  std::optional<gtsam::Pose3> held;
};

/// U residual(T_tail_head, tail, head), U' U = weight * information. A prior is one whose tail is
/// held at the map's origin. At least one end is a variable.
class RelativeResidual final : public gtsam::NoiseModelFactor {
 public:
  RelativeResidual(const End& tail, const End& head, const SE3& T_tail_head,
                   const Mat6& information, double weight, const gtsam::SharedNoiseModel& noise);
  gtsam::Vector unwhitenedError(const gtsam::Values& poses,
                                gtsam::OptionalMatrixVecType H = nullptr) const override;

 private:
  End tail_, head_;
  gtsam::Pose3 T_tail_head_;
  gtsam::Matrix6 U_;
};

class AttitudeResidual final : public gtsam::NoiseModelFactor {
 public:
  AttitudeResidual(gtsam::Key node, const AttitudeFactor& factor);
  gtsam::Vector unwhitenedError(const gtsam::Values& poses,
                                gtsam::OptionalMatrixVecType H = nullptr) const override;

 private:
  gtsam::Matrix3 P_;  ///< projects on the plane normal to up_node, over sigma
};

class PositionResidual final : public gtsam::NoiseModelFactor {
 public:
  PositionResidual(gtsam::Key node, const PositionFactor& factor, double weight,
                   const gtsam::SharedNoiseModel& noise);
  gtsam::Vector unwhitenedError(const gtsam::Values& poses,
                                gtsam::OptionalMatrixVecType H = nullptr) const override;

 private:
  gtsam::Vector3 t_map_;
  gtsam::Matrix3 U_;
};

}  // namespace cambium::gtsam_solver
