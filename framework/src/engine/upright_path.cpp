// SPDX-License-Identifier: BSD-3-Clause
#include "engine/upright_path.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>

namespace cambium {
namespace {

constexpr double steepest = std::numbers::pi / 3;  // hillsides that robots climb stay well below
constexpr double least_width = 3.0;                // [m] standard deviation across the path
constexpr double flat = 0.2;                       // of the width

}  // namespace

std::optional<double> upright_path(const Mission& mission) {
  Vec3 mean = Vec3::Zero();
  for (const Node& node : mission.nodes) mean += node.T_mission_node.t;
  mean /= double(mission.nodes.size());
  Mat3 spread = Mat3::Zero();
  for (const Node& node : mission.nodes) {
    const Vec3 d = node.T_mission_node.t - mean;
    spread += d * d.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Mat3> axes(spread / double(mission.nodes.size()));
  const Vec3 deviation = axes.eigenvalues().cwiseMax(0.0).cwiseSqrt();  // the smallest first
  if (deviation[1] < least_width || deviation[0] > flat * deviation[1]) return std::nullopt;
  const double angle = std::acos(std::min(1.0, std::abs(axes.eigenvectors()(2, 0))));
  return angle > steepest ? std::optional(angle) : std::nullopt;
}

}  // namespace cambium
