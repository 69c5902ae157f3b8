// SPDX-License-Identifier: BSD-3-Clause
#include "cambium/fit.hpp"

#include <fmt/format.h>

#include <cmath>

#include "cambium/error.hpp"

namespace cambium {
namespace {

void check_sizes(std::size_t target, std::size_t source) {
  if (target == source && target > 0) return;
  throw Error(ErrorCode::numeric, "",
              fmt::format("cannot fit {} target points to {} source points; expected as many of "
                          "each, at least one",
                          target, source));
}

using Points = Eigen::Matrix3Xd;

Points columns(std::span<const Vec3> points) {
  Points out(3, Eigen::Index(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) out.col(Eigen::Index(i)) = points[i];
  return out;
}

}  // namespace

SE3 fit_yaw(std::span<const Vec3> target, std::span<const Vec3> source,
            std::span<const double> weights) {
  check_sizes(target.size(), source.size());
  if (!weights.empty()) check_sizes(target.size(), weights.size());
  const auto weight = [&](std::size_t i) { return weights.empty() ? 1.0 : weights[i]; };

  double sum = 0;
  Vec3 mean_target = Vec3::Zero(), mean_source = Vec3::Zero();
  for (std::size_t i = 0; i < target.size(); ++i) {
    sum += weight(i);
    mean_target += weight(i) * target[i];
    mean_source += weight(i) * source[i];
  }
  mean_target /= sum;
  mean_source /= sum;

  double dot = 0, cross = 0;
  for (std::size_t i = 0; i < target.size(); ++i) {
    const Vec3 a = target[i] - mean_target, b = source[i] - mean_source;
    dot += weight(i) * (a.x() * b.x() + a.y() * b.y());
    cross += weight(i) * (b.x() * a.y() - b.y() * a.x());
  }
  SE3 T_target_source = SE3::from_yaw(std::atan2(cross, dot));
  T_target_source.t = mean_target - T_target_source.q * mean_source;
  return T_target_source;
}

SE3 fit_rigid(std::span<const Vec3> target, std::span<const Vec3> source) {
  check_sizes(target.size(), source.size());
  return SE3::from_matrix(Eigen::umeyama(columns(source), columns(target), false));
}

}  // namespace cambium
