// SPDX-License-Identifier: BSD-3-Clause
#include "stems.hpp"

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>
#include <numeric>

namespace tree_align {
namespace {

using cambium::Mat3;
using cambium::Mat6;
using cambium::SE3;
using cambium::Tree;
using cambium::Vec3;
using cambium::Vec6;

constexpr std::size_t nobody = std::numeric_limits<std::size_t>::max();

bool alike(const Tree& a, const Tree& b, double max_dbh_difference) {
  const double difference = std::abs(a.dbh - b.dbh);
  return std::isnan(difference) || difference <= max_dbh_difference;
}

/// For every row of `from` the nearest row of `to` within the radius, or nobody.
std::vector<std::size_t> nearest(const std::vector<Tree>& to, const std::vector<Tree>& from,
                                 const SE3& T_to_from, double radius, double max_dbh_difference) {
  std::vector<std::size_t> out(from.size(), nobody);
  for (std::size_t i = 0; i < from.size(); ++i) {
    const Vec3 p = T_to_from * from[i].base;
    double least = radius;
    for (std::size_t k = 0; k < to.size(); ++k) {
      const double distance = (to[k].base - p).head<2>().norm();
      if (distance >= least || !alike(to[k], from[i], max_dbh_difference)) continue;
      least = distance;
      out[i] = k;
    }
  }
  return out;
}

Mat3 cross(const Vec3& v) {
  Mat3 m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

}  // namespace

std::vector<Tree> usable(const std::vector<Tree>& trees) {
  std::vector<Tree> out;
  for (const Tree& t : trees)
    if (t.base.allFinite() && t.axis.allFinite()) out.push_back(t);
  return out;
}

std::vector<Pair> mutual_pairs(const std::vector<Tree>& target, const std::vector<Tree>& source,
                               const SE3& T_target_source, double radius,
                               double max_dbh_difference) {
  const auto to = nearest(target, source, T_target_source, radius, max_dbh_difference);
  const auto back = nearest(source, target, T_target_source.inverse(), radius, max_dbh_difference);
  std::vector<Pair> out;
  for (std::size_t i = 0; i < source.size(); ++i)
    if (to[i] != nobody && back[to[i]] == i) out.push_back({to[i], i});
  return out;
}

// J = [I, -R [p]x] in pose_graph.hpp's tangent: translation in the target's axes,
// rotation in the source's.
Fit step(const std::vector<Tree>& target, const std::vector<Tree>& source,
         const std::vector<Pair>& pairs, const std::vector<double>& height_weights, const SE3& T,
         const Noise& noise, bool correct_tilt) {
  const Mat3 R = T.rotation();
  Eigen::Matrix<double, 6, 6> H = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::Matrix<double, 6, 1> b = Eigen::Matrix<double, 6, 1>::Zero();
  const double n = double(pairs.size()),
               heights = std::accumulate(height_weights.begin(), height_weights.end(), 0.0);
  double squares = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const Pair& pair = pairs[i];
    const Vec3 r = target[pair.target].base - T * source[pair.source].base;
    const double plane = r.head<2>().squaredNorm();
    squares += plane;
    const double w_plane = 1 / (noise.stem * noise.stem + plane);
    // The bases of a node share the error of its ground: together they count as one.
    const double w_z = heights > 0 ? height_weights[i] / heights / (noise.base * noise.base) : 0;
    const Vec3 weight(w_plane, w_plane, w_z);
    Eigen::Matrix<double, 3, 6> J;
    J << Mat3::Identity(), -R * cross(source[pair.source].base);
    H += J.transpose() * weight.asDiagonal() * J;
    b += J.transpose() * weight.asDiagonal() * r;
  }
  // Gravity: roll and pitch are rotations about the horizontal axes of the target.
  const double tilt = correct_tilt ? noise.tilt : 1e-5;
  const Mat3 gravity =
      R.transpose() * Vec3(1 / (tilt * tilt), 1 / (tilt * tilt), 0).asDiagonal() * R;
  H.bottomRightCorner<3, 3>() += gravity;
  Fit fit;
  fit.rmse = std::sqrt(squares / n);
  const Eigen::Matrix<double, 6, 6> damped =
      H + 1e-12 * H.trace() * Eigen::Matrix<double, 6, 6>::Identity();
  const Vec6 x = damped.ldlt().solve(b);
  fit.T_target_source.t = T.t + x.head<3>();
  Vec6 turn = Vec6::Zero();
  turn.tail<3>() = x.tail<3>();
  fit.T_target_source.q = (T.q * SE3::exp(turn).q).normalized();
  // The reported information knows gravity as it is known, whether it was corrected or not.
  if (!correct_tilt)
    H.bottomRightCorner<3, 3>() += gravity * (tilt * tilt / (noise.tilt * noise.tilt) - 1);
  fit.normal_equations = H;
  return fit;
}

}  // namespace tree_align
