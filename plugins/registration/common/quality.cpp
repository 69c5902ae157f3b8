// SPDX-License-Identifier: BSD-3-Clause
#include "common/quality.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace cambium::registration {
namespace {

Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

}  // namespace

Quality evaluate(const Surface& target, const Patches& source, const SE3& T_target_source,
                 double distance) {
  Quality quality;
  const Eigen::Matrix3d R = T_target_source.rotation();
  const Eigen::Vector3d t = T_target_source.t;
  Eigen::Matrix<double, 6, 6> H = Eigen::Matrix<double, 6, 6>::Zero();
  double sum = 0;
  std::size_t planes = 0, near_plane = 0;
  for (const Patch& patch : source) {
    const Eigen::Vector3d p_source = patch.at.cast<double>();
    const Eigen::Vector3d p = R * p_source + t;
    const Nearest near = target.index.nearest(p.cast<float>(), float(distance), 0);
    if (near.index < 0) continue;
    ++quality.inliers;
    const Patch& q = target.patches[std::size_t(near.index)];
    if (q.normal.isZero()) continue;
    const Eigen::Vector3d n = q.normal.cast<double>();
    const double e = n.dot(p - q.at.cast<double>());
    Eigen::Matrix<double, 6, 1> J;
    J << n, -(n.transpose() * R * cross_matrix(p_source)).transpose();
    H.selfadjointView<Eigen::Lower>().rankUpdate(J);
    sum += e * e;
    near_plane += std::abs(e) < 0.1;
    ++planes;
  }
  quality.normal_equations = H.selfadjointView<Eigen::Lower>();
  if (source.size() == 0 || quality.inliers == 0) return quality;
  quality.overlap = double(quality.inliers) / double(source.size());
  quality.inlier_share = double(near_plane) / double(std::max<std::size_t>(planes, 1));
  quality.rmse = std::sqrt(sum / double(std::max<std::size_t>(planes, 1)));
  return quality;
}

Mat6 information(const Quality& quality, const NoiseModel& noise) {
  // Points lie on surfaces: a patch of correlation_length squared holds (length / spacing)^2.
  const double patch = noise.correlation_length / noise.spacing;
  const double independent_share = 1.0 / std::max(1.0, patch * patch);
  // A perfect fit of clean data is no better than the range noise of a lidar, about 2 cm. Without
  // this bound the slightly tilted normals along edges seem to hold directions that nothing holds.
  constexpr double range_noise = 0.02;
  const double variance = std::max(quality.rmse * quality.rmse, range_noise * range_noise);
  Eigen::Matrix<double, 6, 1> floor;
  floor << Eigen::Vector3d::Constant(noise.translation_floor),
      Eigen::Vector3d::Constant(noise.rotation_floor);
  // (A^-1 + S)^-1 with S = floor^2, without inverting A, which may be singular: in units of the
  // floor it is B (B + I)^-1, and the eigenvalues of B show which directions are held.
  const Eigen::Matrix<double, 6, 6> B =
      floor.asDiagonal() * (quality.normal_equations * (independent_share / variance)) *
      floor.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> eigen(B);
  constexpr double unheld = 30;  // [m] standard deviation where nothing holds
  const double least = std::pow(noise.translation_floor / unheld, 2);
  const Eigen::Matrix<double, 6, 1> held =
      eigen.eigenvalues().unaryExpr([&](double b) { return std::max(b / (1 + b), least); });
  const Eigen::Matrix<double, 6, 6> scaled =
      eigen.eigenvectors() * held.asDiagonal() * eigen.eigenvectors().transpose();
  const Eigen::Matrix<double, 6, 1> inverse = floor.cwiseInverse();
  const Eigen::Matrix<double, 6, 6> result = inverse.asDiagonal() * scaled * inverse.asDiagonal();
  return 0.5 * (result + result.transpose());
}

Vec6 sigmas(const Mat6& information) {
  const Eigen::Matrix<double, 6, 6> dense = information;
  return dense.inverse().diagonal().cwiseSqrt();
}

}  // namespace cambium::registration
