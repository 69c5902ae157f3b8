// SPDX-License-Identifier: BSD-3-Clause
#include "triangles.hpp"

#include <numbers>
#include <optional>

namespace tree_match {
namespace {

using Ids = std::array<std::uint32_t, 3>;

/// Whether some node could have seen both: else their distance includes the drift of a whole round.
bool seen_together(const Stem& a, const Stem& b) { return a.first <= b.last && b.first <= a.last; }

/// The nearest ones first; of two equally far, the first.
class Neighbours {
 public:
  Neighbours(std::span<const Stem> stems, const StemGrid& grid, const TriangleLimits& limits)
      : stems_(stems), grid_(grid), limits_(limits) {}

  std::span<const std::uint32_t> of(std::uint32_t centre) {
    const Stem& s = stems_[centre];
    const float nearest = float(limits_.min_side * limits_.min_side);
    found_.clear();
    grid_.within(s.x, s.y, float(limits_.reach), [&](std::uint32_t i, float squared) {
      if (squared >= nearest && seen_together(s, stems_[i])) found_.emplace_back(squared, i);
    });
    const std::size_t count = std::min(found_.size(), std::size_t(limits_.neighbours));
    std::partial_sort(found_.begin(), found_.begin() + std::ptrdiff_t(count), found_.end());
    ids_.clear();
    for (std::size_t i = 0; i < count; ++i) ids_.push_back(found_[i].second);
    return ids_;
  }

 private:
  std::span<const Stem> stems_;
  const StemGrid& grid_;
  TriangleLimits limits_;
  std::vector<std::pair<float, std::uint32_t>> found_;
  std::vector<std::uint32_t> ids_;
};

/// 21 bits an id: two million stems a mission.
std::uint64_t packed(Ids ids) {
  std::sort(ids.begin(), ids.end());
  return std::uint64_t(ids[0]) << 42 | std::uint64_t(ids[1]) << 21 | ids[2];
}
Ids unpacked(std::uint64_t key) {
  constexpr std::uint64_t mask = (1u << 21) - 1;
  return {std::uint32_t(key >> 42), std::uint32_t(key >> 21 & mask), std::uint32_t(key & mask)};
}

std::vector<std::uint64_t> combinations(std::span<const Stem> stems, const StemGrid& grid,
                                        const TriangleLimits& limits) {
  Neighbours neighbours(stems, grid, limits);
  std::vector<std::uint64_t> out;
  for (std::uint32_t centre = 0; centre < stems.size(); ++centre) {
    const auto ids = neighbours.of(centre);
    for (std::size_t i = 0; i < ids.size(); ++i)
      for (std::size_t j = i + 1; j < ids.size(); ++j) {
        if (limits.centre_tree) out.push_back(packed({centre, ids[i], ids[j]}));
        for (std::size_t k = j + 1; !limits.centre_tree && k < ids.size(); ++k)
          out.push_back(packed({ids[i], ids[j], ids[k]}));
      }
  }
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

float distance(const Stem& a, const Stem& b) {
  return std::sqrt((a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y));
}

std::uint8_t centimetres(float dbh) {
  return std::uint8_t(std::clamp(std::lround(100 * dbh), 0L, 255L));
}
std::int8_t height_step(float dz) {
  if (std::isnan(dz)) return Triangle::unknown_dz;
  return std::int8_t(std::clamp(std::lround(20 * dz), -127L, 127L));
}

std::optional<Triangle> triangle(std::span<const Stem> stems, Ids ids,
                                 const TriangleLimits& limits) {
  const auto opposite = [&](std::size_t v) {
    return distance(stems[ids[(v + 1) % 3]], stems[ids[(v + 2) % 3]]);
  };
  std::array<std::pair<float, std::uint32_t>, 3> sides;
  for (std::size_t v = 0; v < 3; ++v) sides[v] = {opposite(v), ids[v]};
  std::sort(sides.begin(), sides.end());
  if (sides[0].first < limits.min_side || sides[2].first > 65.0f) return std::nullopt;
  for (std::size_t v = 0; v < 2; ++v)
    if (sides[v + 1].first - sides[v].first < limits.min_side_gap) return std::nullopt;
  const Stem &a = stems[sides[0].second], &b = stems[sides[1].second], &c = stems[sides[2].second];
  Triangle t;
  for (std::size_t v = 0; v < 3; ++v) t.side[v] = std::uint16_t(1000 * sides[v].first);
  const double turns = std::atan2(b.y - a.y, b.x - a.x) / (2 * std::numbers::pi);
  t.heading = std::int16_t(std::uint16_t(std::lround(65536 * turns)));
  t.x = (a.x + b.x + c.x) / 3;
  t.y = (a.y + b.y + c.y) / 3;
  t.last = std::max({a.last, b.last, c.last});
  t.dbh = {centimetres(a.dbh), centimetres(b.dbh), centimetres(c.dbh)};
  t.dz = {height_step(b.z - a.z), height_step(c.z - a.z)};
  t.clockwise = (b.x - a.x) * (c.y - a.y) < (b.y - a.y) * (c.x - a.x);
  return t;
}

}  // namespace

std::vector<Triangle> triangles(std::span<const Stem> stems, const StemGrid& grid,
                                const TriangleLimits& limits) {
  std::vector<Triangle> out;
  for (const std::uint64_t key : combinations(stems, grid, limits))
    if (const auto t = triangle(stems, unpacked(key), limits)) out.push_back(*t);
  return out;
}

}  // namespace tree_match
