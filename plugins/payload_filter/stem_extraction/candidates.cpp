// SPDX-License-Identifier: BSD-3-Clause
#include "candidates.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <tuple>

namespace stem_extraction {
namespace {

constexpr float cell = 0.1f, layer = 0.25f, lowest = 0.5f;  // [m]
constexpr int layers = 14;                                  // up to 4 m

struct Cell {
  std::uint16_t seen = 0, upright = 0, known = 0;  // a bit a layer
  int points = 0;
};

class Plan {
 public:
  explicit Plan(double range)
      : range_(float(range)),
        width_(int(std::ceil(2 * range / cell))),
        cells_(std::size_t(width_) * std::size_t(width_)) {}

  void add(const Above& p) {
    const int bin = int(std::floor((p.height - lowest) / layer));
    const int ix = at(p.position.x()), iy = at(p.position.y());
    if (bin < 0 || bin >= layers || ix < 0 || iy < 0 || ix >= width_ || iy >= width_) return;
    Cell& c = cells_[index(ix, iy)];
    c.seen |= std::uint16_t(1u << bin);
    if (p.surface == Surface::upright) c.upright |= std::uint16_t(1u << bin);
    if (p.surface != Surface::unknown) c.known |= std::uint16_t(1u << bin);
    ++c.points;
  }

  /// Of the cell and its eight neighbours.
  Candidate around(int ix, int iy) const {
    Cell sum;
    Candidate out{middle(ix), middle(iy)};
    for (int y = std::max(0, iy - 1); y <= std::min(width_ - 1, iy + 1); ++y)
      for (int x = std::max(0, ix - 1); x <= std::min(width_ - 1, ix + 1); ++x) {
        const Cell& c = cells_[index(x, y)];
        sum.seen |= c.seen, sum.upright |= c.upright, sum.known |= c.known;
        sum.points += c.points;
      }
    out.layers = std::popcount(sum.seen);
    out.upright = std::popcount(sum.upright);
    out.known = std::popcount(sum.known);
    out.points = sum.points;
    return out;
  }

  bool empty(int ix, int iy) const { return cells_[index(ix, iy)].points == 0; }
  int width() const { return width_; }

 private:
  int at(float v) const { return int(std::floor((v + range_) / cell)); }
  float middle(int i) const { return (float(i) + 0.5f) * cell - range_; }
  std::size_t index(int ix, int iy) const {
    return std::size_t(iy) * std::size_t(width_) + std::size_t(ix);
  }

  float range_;
  int width_;
  std::vector<Cell> cells_;
};

}  // namespace

std::vector<Candidate> find_candidates(const std::vector<Above>& points, double range,
                                       const CandidateLimits& limits) {
  Plan plan(range);
  for (const Above& p : points) plan.add(p);
  std::vector<Candidate> out;
  for (int iy = 0; iy < plan.width(); ++iy)
    for (int ix = 0; ix < plan.width(); ++ix) {
      if (plan.empty(ix, iy)) continue;
      const Candidate c = plan.around(ix, iy);
      if (c.layers >= limits.layer_share * layers && c.upright >= limits.min_upright * c.known)
        out.push_back(c);
    }
  const auto order = [](const Candidate& c) {
    return std::tuple(-c.layers - c.upright, -c.points, c.y, c.x);
  };
  std::sort(out.begin(), out.end(),
            [&](const Candidate& a, const Candidate& b) { return order(a) < order(b); });
  return out;
}

}  // namespace stem_extraction
