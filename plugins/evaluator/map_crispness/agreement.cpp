// SPDX-License-Identifier: BSD-3-Clause
#include "agreement.hpp"

#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "cambium/statistics.hpp"

namespace map_crispness {
namespace {

using cambium::SE3;

// Of each scan; fewer do not say how the two lie to each other.
constexpr std::size_t min_neighbours = 5;
// Range noise [m]: keeps the entropy of a perfect surface finite.
constexpr double noise = 0.01;

/// Entropy [nat] of a normal distribution with the spread of the points: ln det(2 pi e S) / 2, the
/// term of the mean map entropy (Droeschel and Behnke, "Local multi-resolution representation for
/// 6D motion estimation", ICRA 2014).
double entropy_of(const std::vector<Vec3>& points) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Vec3& p : points) mean += p / double(points.size());
  Eigen::Matrix3d spread = noise * noise * Eigen::Matrix3d::Identity();
  for (const Vec3& p : points)
    spread += (p - mean) * (p - mean).transpose() / double(points.size());
  return 0.5 * std::log((2 * std::numbers::pi * std::numbers::e * spread).determinant());
}

double mean_entropy(Surface& target, Surface& source, const std::vector<Contact>& contacts,
                    const SE3& T_target_source, double radius) {
  double sum = 0;
  std::size_t count = 0;
  for (const Contact& c : contacts) {
    std::vector<Vec3> near = target.around(c.p_target, radius);
    const auto own = source.around(c.p_source, radius);
    if (near.size() < min_neighbours || own.size() < min_neighbours) continue;
    for (const Vec3& p : own) near.push_back(T_target_source * p);
    sum += entropy_of(near);
    ++count;
  }
  return count > 0 ? sum / double(count) : std::nan("");
}

}  // namespace

Agreement agreement(Surface& target, Surface& source, const cambium::Cloud& points,
                    const SE3& T_target_source, const Reach& reach) {
  const auto contacts = target.contacts(points, T_target_source, reach.contact);
  std::vector<double> all, ground, upright;
  for (const Contact& c : contacts) {
    all.push_back(c.distance);
    (c.kind == Kind::ground ? ground : upright).push_back(c.distance);
  }
  Agreement out{cambium::median(all), cambium::median(ground), cambium::median(upright),
                mean_entropy(target, source, contacts, T_target_source, reach.entropy)};
  if (!points.empty()) out.overlap = double(contacts.size()) / double(points.size());
  return out;
}

}  // namespace map_crispness
