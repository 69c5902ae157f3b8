// SPDX-License-Identifier: BSD-3-Clause
#include "simulate/diameters.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "simulate/random.hpp"

namespace cambium::simulate {
namespace {

constexpr double thinnest = 0.02;  // a stem of which a lidar may see anything [m]

}  // namespace

Weibull weibull_from(double mean, double sd) {
  // (sd / mean)^2 = G(1 + 2/k) / G(1 + 1/k)^2 - 1 falls with the shape k.
  const auto spread_of = [](double k) {
    return std::exp(std::lgamma(1 + 2 / k) - 2 * std::lgamma(1 + 1 / k)) - 1;
  };
  double low = 0.3, high = 300;
  for (int i = 0; i < 100; ++i) {
    const double k = 0.5 * (low + high);
    (spread_of(k) > (sd / mean) * (sd / mean) ? low : high) = k;
  }
  return {low, mean / std::exp(std::lgamma(1 + 1 / low))};
}

double naslund_height(double dbh, double a, double b) {
  const double d = 100 * dbh;  // the formula takes centimetres
  return 1.3 + d * d / ((a + b * d) * (a + b * d));
}

std::vector<double> diameters(const StandSpec& spec, const std::vector<Place>& places,
                              std::uint64_t seed) {
  const Weibull w = weibull_from(spec.dbh_mean, spec.dbh_sd);
  std::vector<double> out;
  for (const Place& p : places)
    out.push_back(std::max(thinnest, Random(seed, "dbh", p.mark).weibull(w.shape, w.scale)));
  if (spec.dominance <= 0) return out;
  // The thickest diameters go to the dominant trees, in the order in which each group drew its
  // own: within a group they stay random.
  const std::vector<bool> dominant = spread(places, spec.dominance);
  std::vector<std::size_t> by_rank(places.size());
  std::iota(by_rank.begin(), by_rank.end(), std::size_t{0});
  std::sort(by_rank.begin(), by_rank.end(), [&](std::size_t a, std::size_t b) {
    if (dominant[a] != dominant[b]) return bool(dominant[a]);
    return out[a] != out[b] ? out[a] > out[b] : places[a].mark < places[b].mark;
  });
  std::vector<double> sorted = out;
  std::sort(sorted.begin(), sorted.end(), std::greater<>());
  for (std::size_t rank = 0; rank < sorted.size(); ++rank) out[by_rank[rank]] = sorted[rank];
  return out;
}

}  // namespace cambium::simulate
