// SPDX-License-Identifier: BSD-3-Clause
#include "consistency.hpp"

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>

namespace cambium::pcm {
namespace {

double squared_distance(const SE3& error, const Mat6& covariance) {
  const Eigen::Matrix<double, 6, 1> e = error.log();
  const Eigen::LDLT<Eigen::Matrix<double, 6, 6>> ldlt(covariance);
  const double d2 = e.dot(ldlt.solve(e));
  return d2 >= 0 ? d2 : std::numeric_limits<double>::infinity();  // also when it is NaN
}

}  // namespace

double cycle_distance(const Measurement& i, const Measurement& j, const Path& tails,
                      const Path& heads) {
  const SE3 T_heads = heads.T_i_j(i.head, j.head), T_tails = tails.T_i_j(j.tail, i.tail);
  const SE3 error = i.T_tail_head * T_heads * j.T_tail_head.inverse() * T_tails;
  // The covariance of the product, factor by factor from the left.
  Mat6 S = through(T_heads.inverse(), i.covariance) + heads.covariance(i.head, j.head);
  S = through(j.T_tail_head, S + j.covariance);
  S = through(T_tails.inverse(), S) + tails.covariance(j.tail, i.tail);
  return squared_distance(error, S);
}

double odometry_distance(const Measurement& loop, const Path& path) {
  const SE3 T_head_tail = path.T_i_j(loop.head, loop.tail);
  const Mat6 S =
      through(T_head_tail.inverse(), loop.covariance) + path.covariance(loop.head, loop.tail);
  return squared_distance(loop.T_tail_head * T_head_tail, S);
}

double chi_square_6(double probability) {
  // For 6 degrees of freedom P(x) = 1 - exp(-h) (1 + h + h^2 / 2), h = x / 2; it only grows.
  double low = 0, high = 1000;
  for (int k = 0; k < 100; ++k) {
    const double x = 0.5 * (low + high), h = 0.5 * x;
    (1 - std::exp(-h) * (1 + h + 0.5 * h * h) < probability ? low : high) = x;
  }
  return 0.5 * (low + high);
}

}  // namespace cambium::pcm
