// SPDX-License-Identifier: BSD-3-Clause
#include "common/robust_fit.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "cambium/fit.hpp"
#include "cambium/statistics.hpp"

namespace cambium::gnss {
namespace {

constexpr std::size_t anchors = 24;  ///< places that hypotheses connect: 276 of them
constexpr std::size_t judges = 500;  ///< pairs that judge a hypothesis
constexpr double median_of_rayleigh = 1.1774100225154747;  ///< sqrt(2 ln 2)

/// Horizontal distance over the stated sigma of one axis.
double residual(const Pair& pair, const SE3& T_map_enu) {
  return (pair.p_map - T_map_enu * pair.p_enu).head<2>().norm() /
         std::sqrt(horizontal_variance(pair.covariance));
}

std::vector<Pair> spread(const std::vector<Pair>& pairs, std::size_t count) {
  if (pairs.size() <= count) return pairs;
  std::vector<Pair> out;
  for (std::size_t k = 0; k < count; ++k)
    out.push_back(pairs[k * (pairs.size() - 1) / (count - 1)]);
  return out;
}

SE3 closed_form(const std::vector<Pair>& pairs, const std::vector<double>& weight) {
  std::vector<Vec3> p_map, p_enu;
  std::vector<double> w;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (weight[i] <= 0) continue;
    p_map.push_back(pairs[i].p_map);
    p_enu.push_back(pairs[i].p_enu);
    w.push_back(weight[i] / horizontal_variance(pairs[i].covariance));
  }
  return fit_yaw(p_map, p_enu, w);
}

struct Start {
  SE3 T_map_enu;
  double median = 0;
};

Start least_median(const std::vector<Pair>& pairs) {
  const std::vector<Pair> jury = spread(pairs, judges), at = spread(pairs, anchors);
  Start best;
  const auto consider = [&](const SE3& T_map_enu) {
    std::vector<double> r;
    for (const Pair& pair : jury) r.push_back(residual(pair, T_map_enu));
    if (const double m = median(std::move(r)); m < best.median) best = {T_map_enu, m};
  };
  best.median = std::numeric_limits<double>::infinity();
  consider(closed_form(pairs, std::vector<double>(pairs.size(), 1)));
  for (std::size_t i = 0; i < at.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) consider(closed_form({at[i], at[j]}, {1, 1}));
  return best;
}

/// Robust scale with Rousseeuw's correction for few pairs.
double scale_of(double median, std::size_t count) {
  return std::max(1.0, median / median_of_rayleigh * (1 + 5 / std::max(1.0, double(count) - 2)));
}

/// Equation (14) of the paper; s and limit are squares.
double gnc_weight(double s, double limit, double mu) {
  if (s >= (mu + 1) / mu * limit) return 0;
  if (s <= mu / (mu + 1) * limit) return 1;
  return std::sqrt(limit * mu * (mu + 1) / s) - mu;
}

SE3 graduate(const std::vector<Pair>& pairs, const Start& start, double limit) {
  SE3 T_map_enu = start.T_map_enu;
  std::vector<double> s(pairs.size()), weight(pairs.size(), 1);
  const auto measure = [&] {
    for (std::size_t i = 0; i < pairs.size(); ++i)
      s[i] = std::pow(residual(pairs[i], T_map_enu), 2);
  };
  measure();
  const double largest = *std::max_element(s.begin(), s.end());
  double mu = 2 * largest > limit ? std::min(1.0, limit / (2 * largest - limit)) : 1e6;
  for (; mu < 1e7; mu *= 1.4) {
    for (std::size_t i = 0; i < pairs.size(); ++i) weight[i] = gnc_weight(s[i], limit, mu);
    if (std::count_if(weight.begin(), weight.end(), [](double w) { return w > 0; }) < 2) break;
    T_map_enu = closed_form(pairs, weight);
    measure();
  }
  return T_map_enu;
}

double weighted_median(std::vector<std::pair<double, double>> value_weight) {
  std::sort(value_weight.begin(), value_weight.end());
  double total = 0, sum = 0;
  for (const auto& [value, weight] : value_weight) total += weight;
  for (std::size_t i = 0; i < value_weight.size(); ++i) {
    sum += value_weight[i].second;
    if (2 * sum > total) return value_weight[i].first;
    if (2 * sum == total && i + 1 < value_weight.size())
      return (value_weight[i].first + value_weight[i + 1].first) / 2;
  }
  return value_weight.back().first;
}

/// Of the fixes kept. The weight of an L1 estimate is 1 / sigma.
double height(const std::vector<Pair>& pairs, const std::vector<bool>& kept) {
  std::vector<std::pair<double, double>> dz;
  for (std::size_t i = 0; i < pairs.size(); ++i)
    if (kept[i])
      dz.emplace_back(pairs[i].p_map.z() - pairs[i].p_enu.z(),
                      1 / std::sqrt(std::max(pairs[i].covariance(2, 2), 1e-8)));
  return weighted_median(std::move(dz));
}

}  // namespace

RobustFit robust_fit(const std::vector<Pair>& pairs, double width) {
  const Start start = least_median(pairs);
  RobustFit out;
  out.scale = scale_of(start.median, pairs.size());
  // The chi-square limit of two axes with the probability of `width` sigmas of one.
  const double limit = -2 * std::log(std::erfc(width / std::sqrt(2.0))) * out.scale * out.scale;
  const SE3 graduated = graduate(pairs, start, limit);
  std::vector<double> weight;
  for (const Pair& pair : pairs) {
    const double r = residual(pair, graduated);
    out.kept.push_back(r * r <= limit);
    weight.push_back(out.kept.back() ? 1 : 0);
  }
  out.T_map_enu = closed_form(pairs, weight);
  out.T_map_enu.t.z() = height(pairs, out.kept);
  return out;
}

}  // namespace cambium::gnss
