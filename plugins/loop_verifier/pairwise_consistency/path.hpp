// SPDX-License-Identifier: BSD-3-Clause
// What a mission's odometry says about any two of its nodes, in constant time.
#pragma once
#include <vector>

#include "cambium/mission.hpp"
#include "covariance.hpp"

namespace cambium::pcm {

/// How far odometry may be trusted, per metre of path.
struct Drift {
  Sigma systematic;  ///< grows with the path: added to what the edges say
  Sigma bound;       ///< of one step: where there is no edge, and where an edge claims less
};

class Path {
 public:
  Path(const Mission& mission, const Drift& drift);

  /// From i to j, as the robot estimated it.
  SE3 T_i_j(std::size_t i, std::size_t j) const {
    return T_first_node_[i].inverse() * T_first_node_[j];
  }

  /// Of T_i_j: the covariances of the steps between, carried to the frame of j, and the drift.
  ///
  /// With T_i_j = prod X_k exp(xi_k) the errors add up to Ad(T_first_j^-1) sum Ad(T_first_k+1)
  /// xi_k, so the sums over k from the first node are enough: those of i are taken from those of j.
  Mat6 covariance(std::size_t i, std::size_t j) const;

  double length(std::size_t i, std::size_t j) const;  ///< [m] along the path

 private:
  Drift drift_;
  std::vector<SE3> T_first_node_;
  std::vector<Mat6> sum_;          ///< of the step covariances before a node, in the first's frame
  std::vector<double> travelled_;  ///< [m]
};

}  // namespace cambium::pcm
