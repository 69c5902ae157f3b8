// SPDX-License-Identifier: BSD-3-Clause
#include "simulate/terrain.hpp"

#include <algorithm>
#include <cmath>

#include "simulate/angles.hpp"
#include "simulate/random.hpp"

namespace cambium::simulate {
namespace {

/// Smooth noise in -1..1: random values on a lattice of width 1, quintic between (Perlin 2002).
double value_noise(double x, double y, const Random& lattice) {
  const double fx = std::floor(x), fy = std::floor(y);
  const auto value = [&](int i, int j) {
    const auto ix = std::uint64_t(std::int64_t(fx) + i), iy = std::uint64_t(std::int64_t(fy) + j);
    return lattice.fork(ix).fork(iy).uniform(-1, 1);
  };
  const auto fade = [](double t) { return t * t * t * (t * (t * 6 - 15) + 10); };
  const double u = fade(x - fx), v = fade(y - fy);
  const double south = std::lerp(value(0, 0), value(1, 0), u);
  const double north = std::lerp(value(0, 1), value(1, 1), u);
  return std::lerp(south, north, v);
}

// Each octave is half as wide and 0.4 times as high as the one before, so it is a bit less steep.
double three_octaves(double x, double y, double wavelength, const Random& lattice) {
  double sum = 0, amplitude = 1;
  for (std::uint64_t octave = 0; octave < 3; ++octave, wavelength /= 2, amplitude *= 0.4)
    sum += amplitude * value_noise(x / wavelength, y / wavelength, lattice.fork(octave));
  return sum;
}

double steepest(const Terrain& t) {
  double most = 0;
  for (int iy = 0; iy < t.ny; ++iy)
    for (int ix = 0; ix < t.nx; ++ix)
      most = std::max<double>(
          most, std::hypot(t.at(ix + 1, iy) - t.at(ix, iy), t.at(ix, iy + 1) - t.at(ix, iy)));
  return most / Terrain::cell;
}

}  // namespace

double Terrain::height(double x, double y) const {
  const double gx = std::clamp((x - x0) / cell, 0.0, nx - 1e-6);
  const double gy = std::clamp((y - y0) / cell, 0.0, ny - 1e-6);
  const int ix = int(gx), iy = int(gy);
  const double u = gx - ix, v = gy - iy;
  return std::lerp(std::lerp(double(at(ix, iy)), double(at(ix + 1, iy)), u),
                   std::lerp(double(at(ix, iy + 1)), double(at(ix + 1, iy + 1)), u), v);
}

Terrain make_terrain(const TerrainSpec& spec, const std::vector<double>& size, std::uint64_t seed) {
  Terrain t;
  t.x0 = -size[0] / 2, t.y0 = -size[1] / 2;
  t.nx = int(std::ceil(size[0] / Terrain::cell)), t.ny = int(std::ceil(size[1] / Terrain::cell));
  const Random hills(seed, "hills"), bumps(seed, "bumps");
  const auto points = std::size_t(t.nx + 1) * std::size_t(t.ny + 1);
  for (std::size_t i = 0; i < points; ++i) {
    const double x = t.x0 + Terrain::cell * double(i % std::size_t(t.nx + 1));
    const double y = t.y0 + Terrain::cell * double(i / std::size_t(t.nx + 1));
    t.heights.push_back(float(three_octaves(x, y, spec.wavelength, hills)));
  }
  const double slope = steepest(t);
  const double scale = slope > 0 ? std::tan(radians(spec.max_slope)) / slope : 0;
  for (std::size_t i = 0; i < points; ++i)
    t.heights[i] = float(scale * t.heights[i] + spec.roughness * bumps.fork(i).normal());
  return t;
}

}  // namespace cambium::simulate
