// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <array>

#include "cambium/se3.hpp"

namespace cambium::registration {

/// A symmetric 3 x 3 matrix, the information of a pair's distance [1/m^2 but for a scale].
struct Weight {
  float xx, xy, xz, yy, yz, zz;
};

inline Weight to_plane(const Eigen::Vector3f& n) {
  return {n.x() * n.x(), n.x() * n.y(), n.x() * n.z(), n.y() * n.y(), n.y() * n.z(), n.z() * n.z()};
}

/// The inverse of C_n + C_m with C_n = I - k n n', k = 1 - thickness. The sum is 2 I - k (nn' +
/// mm'), whose axes are n + m, n - m and their cross product, so with c = n'm the inverse is I/2 +
/// k/4 ss'/(2 - k(1+c)) + k/4 dd'/(2 - k(1-c)), s = n + m, d = n - m. A zero normal is a ball.
inline Weight disc_to_disc(const Eigen::Vector3f& n, const Eigen::Vector3f& m, float thickness) {
  const float k = 1 - thickness, c = n.dot(m);
  const float a = 0.25F * k / (2 - k * (1 + c)), b = 0.25F * k / (2 - k * (1 - c));
  const Eigen::Vector3f s = n + m, d = n - m, as = a * s, bd = b * d;
  return {0.5F + as.x() * s.x() + bd.x() * d.x(), as.x() * s.y() + bd.x() * d.y(),
          as.x() * s.z() + bd.x() * d.z(),        0.5F + as.y() * s.y() + bd.y() * d.y(),
          as.y() * s.z() + bd.y() * d.z(),        0.5F + as.z() * s.z() + bd.z() * d.z()};
}

/// Sum of J'WJ and J'We over pairs, for a step from the left: T <- exp(step) T, J = [I, -[p]x].
class NormalEquations {
 public:
  /// p: the source's patch in the target frame; e: from the target's patch to it [m].
  void add(const Eigen::Vector3f& p, const Eigen::Vector3f& e, const Weight& w) {
    const double x = p.x(), y = p.y(), z = p.z();
    const double a = w.xx, b = w.xy, c = w.xz, d = w.yy, f = w.yz, g = w.zz;
    // W (-[p]x), column by column, and from it [p]x W (-[p]x).
    const double m00 = c * y - b * z, m10 = f * y - d * z, m20 = g * y - f * z;
    const double m01 = a * z - c * x, m11 = b * z - f * x, m21 = c * z - g * x;
    const double m02 = b * x - a * y, m12 = d * x - b * y, m22 = f * x - c * y;
    const double u = a * e.x() + b * e.y() + c * e.z(), v = b * e.x() + d * e.y() + f * e.z(),
                 r = c * e.x() + f * e.y() + g * e.z();
    const std::array<double, 27> terms = {a,
                                          b,
                                          c,
                                          d,
                                          f,
                                          g,
                                          m00,
                                          m10,
                                          m20,
                                          m01,
                                          m11,
                                          m21,
                                          m02,
                                          m12,
                                          m22,
                                          y * m20 - z * m10,
                                          y * m21 - z * m11,
                                          y * m22 - z * m12,
                                          z * m01 - x * m21,
                                          z * m02 - x * m22,
                                          x * m12 - y * m02,
                                          u,
                                          v,
                                          r,
                                          y * r - z * v,
                                          z * u - x * r,
                                          x * v - y * u};
    for (std::size_t i = 0; i < terms.size(); ++i) sums_[i] += terms[i];
    ++pairs_;
  }
  std::size_t pairs() const { return pairs_; }

  /// The Gauss-Newton step (translation; rotation). Directions that nothing holds stay: the
  /// damping is far below what any surface holds.
  Vec6 solve() const {
    const auto& s = sums_;
    Eigen::Matrix<double, 6, 6> H;
    H << s[0], s[1], s[2], s[6], s[9], s[12],     //
        s[1], s[3], s[4], s[7], s[10], s[13],     //
        s[2], s[4], s[5], s[8], s[11], s[14],     //
        s[6], s[7], s[8], s[15], s[16], s[17],    //
        s[9], s[10], s[11], s[16], s[18], s[19],  //
        s[12], s[13], s[14], s[17], s[19], s[20];
    H.diagonal().array() += 1e-9 * H.trace() + 1e-12;
    const Eigen::Map<const Eigen::Matrix<double, 6, 1>> b(sums_.data() + 21);
    return -H.ldlt().solve(b);
  }

 private:
  std::array<double, 27> sums_{};
  std::size_t pairs_ = 0;
};

}  // namespace cambium::registration
