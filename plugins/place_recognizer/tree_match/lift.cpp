// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Cholesky>

#include "alignment.hpp"
#include "cambium/statistics.hpp"

namespace tree_match {

using cambium::Quat;
using cambium::SE3;
using cambium::Vec3;

namespace {

constexpr std::size_t fewest_to_fit = 3;
constexpr double sigma_base = 0.3;  // of the difference of two bases [m]
// A wrong gravity is believed when so many bases bear it out, so many times more than bear out the
// right one. In a simulated forest with 12 degrees: 21 bases or more, 6 times as many. On Evo and
// Venman gravity is right: there ten queries had up to 4.6 times as many, of 14 bases at most, and
// no other more than 1.8 times as many.
constexpr double enough_bases = 18, contradicted = 3;

/// Differences of the bases of matched stems, and where they were measured.
struct Bases {
  std::vector<Vec3> offset;  // from the query's node in the reference's axes [m]
  std::vector<double> dz;
};

struct Plane {
  Vec3 z_roll_pitch;
  double support = 0;  ///< sum of the weights of the bases, each 0..1
  double tilt() const { return z_roll_pitch.tail<2>().norm(); }
};

Bases bases_of(const Overlay& overlay, std::span<const Stem> query, std::span<const Stem> reference,
               const Quat& turned) {
  Bases out;
  for (const Match& m : overlay.matches) {
    const Stem &q = query[m.query], &r = reference[m.reference];
    if (std::isnan(q.z) || std::isnan(r.z)) continue;
    out.offset.push_back(turned * Vec3(q.x, q.y, 0));
    out.dz.push_back(double(r.z) - double(q.z));
  }
  return out;
}

/// `pull`: how strongly gravity holds roll and pitch, of the weight of all bases [m^2].
Plane fit(const Bases& bases, double pull) {
  Plane out{Vec3(cambium::median(bases.dz), 0, 0)};
  // The scale falls from that of a wrong gravity to that of the bases (graduated non-convexity).
  for (double sigma = 3.2; sigma > 0.15; sigma *= 0.8) {
    Eigen::Matrix3d H = Eigen::Matrix3d::Zero();
    Eigen::Vector3d b = Eigen::Vector3d::Zero();
    out.support = 0;
    for (std::size_t i = 0; i < bases.dz.size(); ++i) {
      const Eigen::Vector3d J(1, bases.offset[i].y(), -bases.offset[i].x());
      const double r = (bases.dz[i] - J.dot(out.z_roll_pitch)) / sigma,
                   weight = 1 / ((1 + r * r) * (1 + r * r));
      H += weight * J * J.transpose();
      b += weight * bases.dz[i] * J;
      out.support += weight;
    }
    // Neighbouring bases err alike: together they say as much about the tilt as one of them.
    const double prior = out.support * pull;
    H += Eigen::Vector3d(1e-9, prior, prior).asDiagonal();
    out.z_roll_pitch = H.ldlt().solve(b);
  }
  return out;
}

}  // namespace

std::optional<SE3> lift(const Overlay& overlay, std::span<const Stem> query,
                        std::span<const Stem> reference, double sigma_tilt) {
  const auto [x, y, yaw] = overlay.T_reference_query;
  const Quat turned = SE3::from_yaw(yaw).q;
  const Bases bases = bases_of(overlay, query, reference, turned);
  if (bases.dz.size() < fewest_to_fit) return std::nullopt;
  Plane plane = fit(bases, std::pow(sigma_base / sigma_tilt, 2));
  // Where one mission's gravity is wrong, the bases agree without it and contradict it.
  const Plane free = fit(bases, 1e-6);
  if (free.tilt() > wrong_gravity && free.support > enough_bases &&
      free.support > contradicted * plane.support)
    plane = free;
  const Vec3 tilt(plane.z_roll_pitch.y(), plane.z_roll_pitch.z(), 0);
  const double angle = tilt.norm();
  const Quat tilted(Eigen::AngleAxisd(angle, angle > 0 ? Vec3(tilt / angle) : Vec3::UnitX()));
  return SE3{tilted * turned, Vec3(x, y, plane.z_roll_pitch.x())};
}

}  // namespace tree_match
