// SPDX-License-Identifier: BSD-3-Clause
#include "simulate/foliage.hpp"

#include <algorithm>
#include <cmath>

#include "simulate/random.hpp"

namespace cambium::simulate {
namespace {

constexpr double cell = Terrain::cell;

class Grower {
 public:
  Grower(const FoliageSpec& spec, const Terrain& terrain, double top, std::uint64_t seed)
      : spec_(spec), terrain_(terrain), clumps_(seed, "clumps") {
    const auto [low, high] = std::minmax_element(terrain.heights.begin(), terrain.heights.end());
    f_.nx = terrain.nx, f_.ny = terrain.ny;
    f_.bottom = std::floor(*low);
    const double ceiling = std::max<double>(top, *high + spec.understory_height);
    f_.layers = std::max(1, int(std::ceil((ceiling - f_.bottom) / cell)));
    f_.extinction.assign(std::size_t(f_.nx) * std::size_t(f_.ny) * std::size_t(f_.layers), 0.f);
  }

  void crown(const Stem& stem, double mean_dbh) {
    const double length = (1 - spec_.crown_base) * stem.height;
    const Vec3 center = stem.base + (stem.height - 0.5 * length) * stem.axis;
    const double radius = spec_.crown_radius * std::sqrt(stem.dbh / mean_dbh);
    const int reach = int(std::ceil(radius / cell)) + 1;
    const int cx = column(center.x() - terrain_.x0), cy = column(center.y() - terrain_.y0);
    const int bottom = layer(center.z() - 0.5 * length), top = layer(center.z() + 0.5 * length);
    for (int iy = std::max(0, cy - reach); iy <= std::min(f_.ny - 1, cy + reach); ++iy)
      for (int ix = std::max(0, cx - reach); ix <= std::min(f_.nx - 1, cx + reach); ++ix)
        for (int iz = std::max(0, bottom); iz <= std::min(f_.layers - 1, top); ++iz) {
          const Vec3 d = middle(ix, iy, iz) - center;
          const double r = d.head<2>().norm() / radius, h = d.z() / (0.5 * length);
          if (r * r + h * h < 1) add(ix, iy, iz, spec_.extinction);
        }
  }

  void understory() {
    for (int iy = 0; iy < f_.ny; ++iy)
      for (int ix = 0; ix < f_.nx; ++ix) {
        const Vec3 m = middle(ix, iy, 0);
        const double ground = terrain_.height(m.x(), m.y());
        for (int iz = std::max(0, layer(ground)); iz < f_.layers; ++iz) {
          const double low = std::max(ground, f_.bottom + iz * cell);
          const double high =
              std::min(ground + spec_.understory_height, f_.bottom + (iz + 1) * cell);
          if (high <= low) break;
          add(ix, iy, iz, spec_.understory * (high - low) / cell);
        }
      }
  }

  Foliage take() { return std::move(f_); }

 private:
  static int column(double d) { return int(std::floor(d / cell)); }
  int layer(double z) const { return int(std::floor((z - f_.bottom) / cell)); }
  Vec3 middle(int ix, int iy, int iz) const {
    return {terrain_.x0 + (ix + 0.5) * cell, terrain_.y0 + (iy + 0.5) * cell,
            f_.bottom + (iz + 0.5) * cell};
  }
  // Clumps are a property of the place: every mission sees the same dense and thin voxels.
  void add(int ix, int iy, int iz, double extinction) {
    Random r = clumps_.fork(std::uint64_t(ix)).fork(std::uint64_t(iy)).fork(std::uint64_t(iz));
    const double s = spec_.clumping;
    f_.at(ix, iy, iz) += float(extinction * std::exp(s * r.normal() - 0.5 * s * s));
  }

  const FoliageSpec& spec_;
  const Terrain& terrain_;
  Random clumps_;
  Foliage f_;
};

}  // namespace

Foliage grow(const FoliageSpec& spec, const StandSpec& stand, const Terrain& terrain,
             const std::vector<Stem>& stems, std::uint64_t seed) {
  double top = 0;
  for (const Stem& s : stems) top = std::max(top, s.base.z() + s.height);
  Grower grower(spec, terrain, top, seed);
  if (spec.extinction > 0)
    for (const Stem& s : stems) grower.crown(s, stand.dbh_mean);
  if (spec.understory > 0) grower.understory();
  return grower.take();
}

}  // namespace cambium::simulate
