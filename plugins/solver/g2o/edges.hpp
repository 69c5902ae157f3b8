// SPDX-License-Identifier: BSD-3-Clause
// The factors of cambium/pose_graph.hpp for g2o. g2o's EdgeSE3 measures rotations with vec(q) where
// the one cost has 2 vec(q), and translations in the measured head's frame, not in the tail's:
// r = (R_tail_head r_t; 2 r_q). With the information of those, F is the same. A vertex moves by
// (dt; vec(dq)), both in its own frame: half an angle.
#pragma once
#include <g2o/core/base_unary_edge.h>
#include <g2o/core/robust_kernel.h>
#include <g2o/types/slam3d/edge_se3.h>
#include <g2o/types/slam3d/vertex_se3.h>

#include "cambium/pose_graph.hpp"
#include "common/loss.hpp"

namespace cambium::g2o_solver {

g2o::Isometry3 to_isometry(const SE3& T);
SE3 from_isometry(const g2o::Isometry3& T);
/// The information of an EdgeSE3's error, from that of the one cost's residual.
Mat6 for_edge_se3(const Mat6& information, const SE3& T_tail_head);

class Kernel final : public g2o::RobustKernel {
 public:
  explicit Kernel(const pose_solver::Loss& loss) : loss_(loss) {}
  void robustify(double squared_error, g2o::Vector3& rho) const override {
    loss_.evaluate(squared_error, rho.data());
  }

 private:
  pose_solver::Loss loss_;
};

/// A vertex alone with what is known of it; no file format.
class UnaryEdge : public g2o::BaseUnaryEdge<3, g2o::Vector3, g2o::VertexSE3> {
 public:
  bool read(std::istream&) override { return false; }
  bool write(std::ostream&) const override { return false; }

 protected:
  const g2o::Isometry3& pose() const {
    return static_cast<const g2o::VertexSE3*>(_vertices[0])->estimate();
  }
};

/// The part of R'z normal to the measurement, the upward direction in the node's frame.
class EdgeAttitude final : public UnaryEdge {
 public:
  explicit EdgeAttitude(const AttitudeFactor& factor);
  void computeError() override;
  void linearizeOplus() override;

 private:
  Eigen::Matrix3d P_;  ///< projects on the plane normal to it
};

/// t minus the measurement.
class EdgePosition final : public UnaryEdge {
 public:
  EdgePosition(const PositionFactor& factor, double weight);
  void computeError() override;
  void linearizeOplus() override;
};

}  // namespace cambium::g2o_solver
