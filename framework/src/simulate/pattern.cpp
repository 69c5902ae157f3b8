// SPDX-License-Identifier: BSD-3-Clause
#include "simulate/pattern.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cambium/error.hpp"
#include "simulate/random.hpp"

namespace cambium::simulate {
namespace {

constexpr double square_metres = 1e4;  // in a hectare

bool inside(const std::vector<double>& size, double x, double y) {
  return std::abs(x) < size[0] / 2 && std::abs(y) < size[1] / 2;
}

bool in_clearing(const std::vector<double>& circles, double x, double y) {
  for (std::size_t i = 0; i < circles.size(); i += 3)
    if (std::hypot(x - circles[i], y - circles[i + 1]) < circles[i + 2]) return true;
  return false;
}

// Each cell of 2 m draws from its own stream: a larger area keeps the trees of a smaller one.
template <class Add>
void for_poisson_points(const std::vector<double>& size, double density, const Random& stream,
                        Add add) {
  constexpr double cell = 2.0;
  const auto mx = std::int64_t(std::ceil(size[0] / 2 / cell));
  const auto my = std::int64_t(std::ceil(size[1] / 2 / cell));
  for (std::int64_t iy = -my; iy < my; ++iy)
    for (std::int64_t ix = -mx; ix < mx; ++ix) {
      Random r = stream.fork(std::uint64_t(ix)).fork(std::uint64_t(iy));
      for (int n = r.poisson(density / square_metres * cell * cell); n > 0; --n) {
        const double x = (double(ix) + r.uniform()) * cell;
        const double y = (double(iy) + r.uniform()) * cell;
        add(x, y, r);
      }
    }
}

// The intensity of a Poisson process that Matern's thinning brings down to `density`.
double before_thinning(double density, double hard_core) {
  const double disc = std::numbers::pi * hard_core * hard_core;
  return -std::log1p(-density / square_metres * disc) / disc * square_metres;
}

std::vector<Place> matern(const StandSpec& s, std::uint64_t seed) {
  return thinned(poisson_places(s.size, before_thinning(s.density, s.hard_core), seed, "matern"),
                 s.hard_core);
}

std::vector<Place> lattice(const StandSpec& s, std::uint64_t seed) {
  const double step = std::sqrt(square_metres / s.density);
  const Random stream(seed, "lattice");
  std::vector<Place> out;
  for (double y = -s.size[1] / 2 + step / 2; y < s.size[1] / 2; y += step)
    for (double x = -s.size[0] / 2 + step / 2; x < s.size[0] / 2; x += step) {
      Random r = stream.fork(out.size());
      const double dx = s.jitter * r.normal(), dy = s.jitter * r.normal();
      out.push_back({x + dx, y + dy, r.next()});
    }
  return out;
}

// Thomas' process (1949), with more and more clusters until enough stems are left by the hard
// core; then the lowest marks are kept.
std::vector<Place> clustered(const StandSpec& s, std::uint64_t seed) {
  const auto wanted = std::size_t(std::lround(s.density / square_metres * s.size[0] * s.size[1]));
  for (double excess = 1.2; excess < 40; excess *= 1.3) {
    std::vector<Place> points;
    for_poisson_points(
        s.size, excess * s.density / s.cluster_size, Random(seed, "clusters"),
        [&](double x, double y, Random& r) {
          for (int n = r.poisson(s.cluster_size); n > 0; --n) {
            const double dx = r.normal(), dy = r.normal();
            points.push_back({x + s.cluster_radius * dx, y + s.cluster_radius * dy, r.next()});
          }
        });
    std::erase_if(points, [&](const Place& p) { return !inside(s.size, p.x, p.y); });
    points = thinned(points, s.hard_core);
    if (points.size() < wanted) continue;
    std::sort(points.begin(), points.end(),
              [](const Place& a, const Place& b) { return a.mark < b.mark; });
    points.resize(wanted);
    return points;
  }
  throw Error(ErrorCode::config, "stand",
              "no clustered stand of this density and hard core was found; lower one of them or "
              "raise cluster_radius");
}

}  // namespace

std::vector<Place> poisson_places(const std::vector<double>& size, double density,
                                  std::uint64_t seed, std::string_view purpose) {
  std::vector<Place> out;
  for_poisson_points(size, density, Random(seed, purpose), [&](double x, double y, Random& r) {
    const std::uint64_t mark = r.next();
    if (inside(size, x, y)) out.push_back({x, y, mark});
  });
  return out;
}

std::vector<Place> outside(const std::vector<double>& circles, std::vector<Place> places) {
  std::erase_if(places, [&](const Place& p) { return in_clearing(circles, p.x, p.y); });
  return places;
}

std::vector<Place> stem_places(const StandSpec& s, std::uint64_t seed) {
  if (s.density <= 0) return {};
  return outside(s.clearings, s.pattern == "matern"    ? matern(s, seed)
                              : s.pattern == "lattice" ? lattice(s, seed)
                                                       : clustered(s, seed));
}

}  // namespace cambium::simulate
