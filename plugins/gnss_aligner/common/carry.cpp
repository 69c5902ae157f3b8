// SPDX-License-Identifier: BSD-3-Clause
#include "common/carry.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "cambium/fused.hpp"
#include "cambium/geodesy.hpp"

namespace cambium::gnss {
namespace {

Geodetic place(const GeoReference& g) { return {g.latitude, g.longitude, g.altitude}; }

/// Tangent planes at two references differ by a rigid transform: p_a = T_a_b * p_b.
SE3 between_references(const Geodetic& a, const Geodetic& b) {
  const auto into_a = [&](const Vec3& p_b) { return to_enu(a, from_enu(b, p_b)); };
  Mat4 T = Mat4::Identity();
  const Vec3 origin = into_a(Vec3::Zero());
  constexpr double lever = 1000;  // [m], long against the rounding of degrees
  for (int axis = 0; axis < 3; ++axis)
    T.block<3, 1>(0, axis) = (into_a(lever * Vec3::Unit(axis)) - origin) / lever;
  T.block<3, 1>(0, 3) = origin;
  return SE3::from_matrix(T);
}

/// One mission's georeference, as the map sees it.
struct Carried {
  SE3 T_map_enu;    // ENU at the first mission's reference point
  Vec3 centre_map;  // of the mission's nodes
  double sigma_yaw, sigma_position;
};

Vec3 centre(const std::vector<SE3>& poses) {
  Vec3 sum = Vec3::Zero();
  for (const SE3& pose : poses) sum += pose.t;
  return poses.empty() ? sum : Vec3(sum / double(poses.size()));
}

/// Mean rotation (Markley et al., "Averaging quaternions", 2007) and the translation that keeps the
/// missions' centres where their own georeferences put them, on average: averaging translations
/// would turn a yaw difference into metres, as the origin of ENU may be far from the map.
SE3 mean(const std::vector<Carried>& all) {
  if (all.size() == 1) return all.front().T_map_enu;
  Eigen::Matrix4d sum = Eigen::Matrix4d::Zero();
  for (const Carried& c : all) sum += c.T_map_enu.q.coeffs() * c.T_map_enu.q.coeffs().transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> solver(sum);
  SE3 T_map_enu;
  T_map_enu.q.coeffs() = solver.eigenvectors().col(3);
  if (T_map_enu.q.w() < 0) T_map_enu.q.coeffs() *= -1;  // the sign of an eigenvector is arbitrary
  for (const Carried& c : all)
    T_map_enu.t += c.centre_map - T_map_enu.q * (c.T_map_enu.inverse() * c.centre_map);
  T_map_enu.t /= double(all.size());
  return T_map_enu;
}

/// What is known of a mean of independent values; 0 when one of them does not say.
template <class Sigma>
double sigma_of_mean(const std::vector<Carried>& all, Sigma sigma) {
  double variance = 0;
  for (const Carried& c : all) {
    if (!(sigma(c) > 0)) return 0;
    variance += sigma(c) * sigma(c);
  }
  return std::sqrt(variance) / double(all.size());
}

}  // namespace

GnssAlignment or_carried(const GnssAlignment& refused, const Atlas& atlas, const Island& island) {
  std::vector<Carried> all;
  std::optional<GeoReference> first;
  for (const std::uint32_t m : island.missions) {
    const MissionState& state = atlas.missions[m];
    const auto& own = state.mission->georeference;
    if (!own) continue;
    if (!first) first = own;
    all.push_back(
        {T_map_mission(state) * own->T_map_enu * between_references(place(*own), place(*first)),
         centre(*state.T_map_node), own->sigma_yaw, own->sigma_position});
  }
  if (all.empty()) return refused;
  GnssAlignment out;
  out.reason = "taken from the missions' own GNSS lines: " + refused.reason;
  GeoReference g = *first;
  g.T_map_enu = mean(all);
  g.sigma_yaw = sigma_of_mean(all, [](const Carried& c) { return c.sigma_yaw; });
  g.sigma_position = sigma_of_mean(all, [](const Carried& c) { return c.sigma_position; });
  double yaw = 0, position = 0;
  for (const Carried& c : all) {
    const SE3 difference = g.T_map_enu * c.T_map_enu.inverse();
    yaw = std::max(yaw, std::abs(difference.yaw()));
    position = std::max(position, (difference * c.centre_map - c.centre_map).norm());
  }
  out.georeference = g;
  out.scores = {{"georeferenced_missions", double(all.size())},
                {"max_yaw_difference", yaw},
                {"max_position_difference", position}};
  return out;
}

}  // namespace cambium::gnss
