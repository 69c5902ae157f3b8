// SPDX-License-Identifier: BSD-3-Clause
#include "engine/pair_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "cambium/fit.hpp"

namespace cambium {
namespace {

// Ties closer than this to the median one agree, however well the others do: a body is rigid to so
// much only [m].
constexpr double rigid_to = 0.5;
constexpr std::size_t max_hypotheses = 200;

std::array<Vec3, 4> points_of(const Tie& tie) {
  const Vec3& p = tie.p_second;
  return {p, p + tie_lever * Vec3::UnitX(), p + tie_lever * Vec3::UnitY(),
          p + tie_lever * Vec3::UnitZ()};
}

double disagreement(const SE3& T, const Tie& tie) {
  double sum = 0;
  for (const Vec3& p : points_of(tie)) sum += (T * p - tie.T_first_second * p).squaredNorm();
  return std::sqrt(sum / 4);
}

double median_disagreement(const SE3& T, const std::vector<Tie>& ties) {
  std::vector<double> d;
  for (const Tie& t : ties) d.push_back(disagreement(T, t));
  std::nth_element(d.begin(), d.begin() + std::ptrdiff_t(d.size() / 2), d.end());
  return d[d.size() / 2];
}

// At most so many hypotheses, evenly spread over the ties.
std::pair<SE3, double> most_central(const std::vector<Tie>& ties) {
  const std::size_t step = std::max<std::size_t>(1, ties.size() / max_hypotheses);
  std::pair<SE3, double> best{ties.front().T_first_second,
                              median_disagreement(ties.front().T_first_second, ties)};
  for (std::size_t i = step; i < ties.size(); i += step) {
    const double m = median_disagreement(ties[i].T_first_second, ties);
    if (m < best.second) best = {ties[i].T_first_second, m};
  }
  return best;
}

void summarise(const std::vector<Vec3>& points, PairFit& fit) {
  for (const Vec3& p : points) fit.centre += p / double(points.size());
  for (const Vec3& p : points) {
    const Vec3 d = p - fit.centre;
    fit.scatter += d * d.transpose() / double(points.size());
  }
}

}  // namespace

double PairFit::distance(const SE3& T) const {
  const Mat3 turn = T.rotation() - T_first_second.rotation();
  const double by_turn = (turn * scatter * turn.transpose()).trace();
  return std::sqrt(std::max(0.0, (T * centre - T_first_second * centre).squaredNorm() + by_turn));
}

PairFit fit_pair(const std::vector<Tie>& ties) {
  const auto [T, median] = most_central(ties);
  // 1.4826 makes the median a sigma; beyond three of them a tie says something else.
  const double limit = std::max(rigid_to, 3 * 1.4826 * median);
  PairFit fit;
  std::vector<Vec3> first, second;
  for (const Tie& tie : ties) {
    if (disagreement(T, tie) > limit) continue;
    ++fit.agreeing;
    for (const Vec3& p : points_of(tie)) {
      second.push_back(p);
      first.push_back(tie.T_first_second * p);
    }
  }
  fit.T_first_second = fit_rigid(first, second);
  summarise(second, fit);
  return fit;
}

}  // namespace cambium
