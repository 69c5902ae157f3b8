// SPDX-License-Identifier: BSD-3-Clause
#include "simulate/stand.hpp"

#include <algorithm>
#include <cmath>

#include "simulate/angles.hpp"
#include "simulate/diameters.hpp"
#include "simulate/pattern.hpp"
#include "simulate/random.hpp"

namespace cambium::simulate {
namespace {

constexpr double breast_height = 1.3;  // [m]

Vec3 on_ground(const Terrain& terrain, const Place& p) {
  return {p.x, p.y, terrain.height(p.x, p.y)};
}

}  // namespace

double Stem::radius_at(double along) const {
  // Things lower than breast height have no diameter there; they taper from their base.
  const double reference = std::min(breast_height, 0.5 * height);
  return 0.5 * dbh * std::max(0.0, (height - along) / (height - reference));
}

std::vector<Stem> plant(const StandSpec& s, const Terrain& terrain, std::uint64_t seed) {
  const std::vector<Place> places = stem_places(s, seed);
  const std::vector<double> dbh = diameters(s, places, seed);
  std::vector<Stem> out;
  for (std::size_t i = 0; i < places.size(); ++i) {
    Random r(seed, "stem", places[i].mark);
    Stem stem;
    stem.base = on_ground(terrain, places[i]);
    stem.dbh = dbh[i];
    stem.height = std::max(
        2.0, naslund_height(stem.dbh, s.naslund_a, s.naslund_b) + s.height_sd * r.normal());
    const double about_x = r.normal(), about_y = r.normal();
    stem.axis = leaning(radians(s.lean) * about_x, radians(s.lean) * about_y);
    stem.mark = places[i].mark;
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

std::vector<Stem> after_growth(std::vector<Stem> stems, double mean, std::uint64_t seed) {
  for (Stem& s : stems) s.dbh += mean * Random(seed, "growth", s.mark).uniform(0.5, 1.5);
  return stems;
}

}  // namespace cambium::simulate
