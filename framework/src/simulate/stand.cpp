// SPDX-License-Identifier: BSD-3-Clause
#include "simulate/stand.hpp"

#include <algorithm>
#include <cmath>

#include "simulate/angles.hpp"
#include "simulate/pattern.hpp"
#include "simulate/random.hpp"

namespace cambium::simulate {
namespace {

constexpr double breast_height = 1.3;  // [m]
constexpr double thinnest = 0.02;      // a stem of which a lidar may see anything [m]

Vec3 on_ground(const Terrain& terrain, const Place& p) {
  return {p.x, p.y, terrain.height(p.x, p.y)};
}

}  // namespace

double Stem::radius_at(double along) const {
  // Things lower than breast height have no diameter there; they taper from their base.
  const double reference = std::min(breast_height, 0.5 * height);
  return 0.5 * dbh * std::max(0.0, (height - along) / (height - reference));
}

Weibull weibull_from(double mean, double sd) {
  // (sd / mean)^2 = G(1 + 2/k) / G(1 + 1/k)^2 - 1 falls with the shape k.
  const auto spread = [](double k) {
    return std::exp(std::lgamma(1 + 2 / k) - 2 * std::lgamma(1 + 1 / k)) - 1;
  };
  double low = 0.3, high = 300;
  for (int i = 0; i < 100; ++i) {
    const double k = 0.5 * (low + high);
    (spread(k) > (sd / mean) * (sd / mean) ? low : high) = k;
  }
  return {low, mean / std::exp(std::lgamma(1 + 1 / low))};
}

double naslund_height(double dbh, double a, double b) {
  const double d = 100 * dbh;  // the formula takes centimetres
  return breast_height + d * d / ((a + b * d) * (a + b * d));
}

std::vector<Stem> plant(const StandSpec& s, const Terrain& terrain, std::uint64_t seed) {
  const Weibull diameters = weibull_from(s.dbh_mean, s.dbh_sd);
  std::vector<Stem> out;
  for (const Place& place : stem_places(s, seed)) {
    Random r(seed, "stem", place.mark);
    Stem stem;
    stem.base = on_ground(terrain, place);
    stem.dbh = std::max(thinnest, r.weibull(diameters.shape, diameters.scale));
    stem.height = std::max(
        2.0, naslund_height(stem.dbh, s.naslund_a, s.naslund_b) + s.height_sd * r.normal());
    const double about_x = r.normal(), about_y = r.normal();
    stem.axis = leaning(radians(s.lean) * about_x, radians(s.lean) * about_y);
    stem.mark = place.mark;
    out.push_back(stem);
  }
  return out;
}

std::vector<Stem> scatter_clutter(const ClutterSpec& s, const StandSpec& stand,
                                  const Terrain& terrain, std::uint64_t seed) {
  std::vector<Stem> out;
  for (const Place& place :
       outside(stand.clearings, poisson_places(stand.size, s.density, seed, "clutter"))) {
    Random r(seed, "snag", place.mark);
    Stem stem;
    stem.base = on_ground(terrain, place);
    stem.dbh = r.uniform(0.04, 0.2);
    stem.height = r.uniform(0.3, 1.0) * s.max_height;
    const double about_x = r.normal(), about_y = r.normal();
    stem.axis = leaning(radians(s.lean) * about_x, radians(s.lean) * about_y);
    stem.mark = place.mark;
    out.push_back(stem);
  }
  return out;
}

std::vector<Stem> after_harvest(const std::vector<Stem>& stems, double share, std::uint64_t seed) {
  std::vector<Stem> out;
  std::copy_if(stems.begin(), stems.end(), std::back_inserter(out),
               [&](const Stem& s) { return Random(seed, "harvest", s.mark).uniform() >= share; });
  return out;
}

}  // namespace cambium::simulate
