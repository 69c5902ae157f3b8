// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Cholesky>

#include "alignment.hpp"
#include "cambium/statistics.hpp"

namespace tree_match {

using cambium::Quat;
using cambium::SE3;
using cambium::Vec3;

std::optional<SE3> lift(const Overlay& overlay, std::span<const Stem> query,
                        std::span<const Stem> reference, double sigma_tilt) {
  constexpr std::size_t fewest_to_fit = 3;
  constexpr double sigma_base = 0.3;  // of the difference of two bases [m]
  const auto [x, y, yaw] = overlay.T_reference_query;
  const Quat turned = SE3::from_yaw(yaw).q;
  std::vector<Vec3> offset;  // from the query's node in the reference's axes
  std::vector<double> dz;
  for (const Match& m : overlay.matches) {
    const Stem &q = query[m.query], &r = reference[m.reference];
    if (std::isnan(q.z) || std::isnan(r.z)) continue;
    offset.push_back(turned * Vec3(q.x, q.y, 0));
    dz.push_back(double(r.z) - double(q.z));
  }
  if (dz.size() < fewest_to_fit) return std::nullopt;
  Vec3 plane(cambium::median(dz), 0, 0);  // z, roll, pitch
  // The scale falls from that of a wrong gravity to that of the bases (graduated non-convexity).
  for (double sigma = 3.2; sigma > 0.15; sigma *= 0.8) {
    Eigen::Matrix3d H = Eigen::Matrix3d::Zero();
    Eigen::Vector3d b = Eigen::Vector3d::Zero();
    double sum = 0;
    for (std::size_t i = 0; i < dz.size(); ++i) {
      const Eigen::Vector3d J(1, offset[i].y(), -offset[i].x());
      const double r = (dz[i] - J.dot(plane)) / sigma, weight = 1 / ((1 + r * r) * (1 + r * r));
      H += weight * J * J.transpose();
      b += weight * dz[i] * J;
      sum += weight;
    }
    // Neighbouring bases err alike: together they say as much about the tilt as one of them.
    const double prior = sum * std::pow(sigma_base / sigma_tilt, 2);
    H += Eigen::Vector3d(1e-9, prior, prior).asDiagonal();
    plane = H.ldlt().solve(b);
  }
  const Vec3 tilt(plane.y(), plane.z(), 0);
  const double angle = tilt.norm();
  const Quat tilted(Eigen::AngleAxisd(angle, angle > 0 ? Vec3(tilt / angle) : Vec3::UnitX()));
  return SE3{tilted * turned, Vec3(x, y, plane.x())};
}

}  // namespace tree_match
