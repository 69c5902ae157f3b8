// SPDX-License-Identifier: BSD-3-Clause
#include "judgement.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace stem_extraction {
namespace {

constexpr double layer = 0.25, lowest = 0.5;  // [m]
constexpr std::size_t layers = 26;            // up to 7 m
constexpr double contrast = 3.0;              // of the densities on the surface and around it
constexpr double gap = 0.2, ring = 0.2;       // around the stem, free, and what is compared [m]

struct Layer {
  double on = 0, inside = 0, around = 0;  // points
};

using Layers = std::array<Layer, layers>;

Layers count(const Stem& stem, const Points& points, double tolerance) {
  Layers out{};
  for (const auto& [p, ray] : points) {
    const double bin = std::floor((p.z() - lowest) / layer);
    if (bin < 0 || bin >= double(layers)) continue;
    Layer& l = out[std::size_t(bin)];
    const double r = stem.residual(p);
    if (std::abs(r) <= tolerance)
      l.on += 1;
    else if (r < -tolerance)
      l.inside += 1;
    else if (r > gap && r < gap + ring)
      l.around += 1;
  }
  return out;
}

/// Area of a ring [m^2].
double area(double from, double width) { return std::numbers::pi * (2 * from + width) * width; }

}  // namespace

Judgement judge(const Stem& stem, const Points& points) {
  const double tolerance = std::clamp(2.5 * stem.sigma, 0.03, 0.08);
  const Layers found = count(stem, points, tolerance);
  const double own = area(std::max(0.0, stem.radius - tolerance), 2 * tolerance);
  const double other = area(stem.radius + gap, ring);
  Judgement out;
  double on = 0, inside = 0;
  std::size_t shown = 0, top = 0;
  for (std::size_t i = 0; i < layers; ++i) {
    const Layer& l = found[i];
    if (double(i) * layer < 2.0) on += l.on, inside += l.inside;
    if (l.on == 0 || l.on / own < contrast * l.around / other) continue;
    ++shown;
    // The stem is followed as long as half of the layers up to here show it.
    if (2 * shown >= i + 1) top = i + 1, out.continuity = double(shown) / double(i + 1);
  }
  out.reach = lowest + double(top) * layer;
  out.inside = on > 0 ? inside / on : 1;
  const double round = std::min(1.0, stem.coverage / 0.5);
  const double sharp = std::clamp(1.5 - stem.sigma / 0.04, 0.0, 1.0);
  const double clean = std::clamp(1.2 - 2 * out.inside, 0.0, 1.0);
  out.score = std::clamp(out.continuity * round * sharp * clean, 0.0, 1.0);
  return out;
}

}  // namespace stem_extraction
