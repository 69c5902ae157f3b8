// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "cambium/statistics.hpp"
#include "monitor/heights.hpp"

namespace cambium::monitor {
namespace {

/// The survey in the map that T leads to.
Atlas moved(const Survey& survey, const SE3& T) {
  Atlas out = survey.clouds;
  for (const std::uint32_t m : survey.missions) {
    std::vector<SE3> poses;
    for (const SE3& T_map_node : *out.missions[m].T_map_node) poses.push_back(T * T_map_node);
    out.missions[m].T_map_node = std::make_shared<const std::vector<SE3>>(std::move(poses));
  }
  return out;
}

/// Around the ground that the first survey knows; nothing else can be compared.
Grid grid_around(const Ground& ground, double cell_size) {
  Grid grid;
  grid.cell_size = cell_size;
  double level = std::numeric_limits<double>::infinity();
  grid.low = grid.high = ground.cells().begin()->first;
  for (const auto& [cell, p] : ground.cells()) {
    for (int k = 0; k < 2; ++k) {
      grid.low[k] = std::min(grid.low[k], cell[k]);
      grid.high[k] = std::max(grid.high[k], cell[k]);
    }
    level = std::min(level, p.z());
  }
  grid.level = level - 5;
  return grid;
}

/// What lies between the grounds of two maps around a place: mostly the maps' own errors, which
/// would show as growth of every crown.
class GroundOffsets {
 public:
  void add(const Cell& cell, double difference) { blocks_[block(cell)].push_back(difference); }

  /// Over 3 x 3 blocks; nothing where the ground is not known.
  std::optional<double> around(const Cell& cell) const {
    const Cell middle = block(cell);
    std::vector<double> near;
    for (int i = -1; i <= 1; ++i)
      for (int j = -1; j <= 1; ++j)
        if (const auto it = blocks_.find({middle[0] + i, middle[1] + j}); it != blocks_.end())
          near.insert(near.end(), it->second.begin(), it->second.end());
    return near.empty() ? std::nullopt : std::optional(median(near));
  }

 private:
  static Cell block(const Cell& cell) {
    constexpr double width = 10;  // [cells]
    return {int(std::floor(cell[0] / width)), int(std::floor(cell[1] / width))};
  }
  std::map<Cell, std::vector<double>> blocks_;
};

/// Of the tops of one cell. Who reports the lower one must have looked where the other one is.
std::optional<double> canopy_change(const Rays& before, const Rays& after, std::size_t cell) {
  const auto a = before.top(cell), b = after.top(cell);
  if (!a || !b) return std::nullopt;
  const Rays& lower = *a < *b ? before : after;
  if (!lower.looked(cell, std::max(*a, *b))) return std::nullopt;
  return *b - *a;
}

}  // namespace

std::vector<CellChange> compare_heights(const Survey& before, const Survey& after,
                                        const SE3& T_before_after, const GroundOptions& options,
                                        const Context& context) {
  std::vector<CellChange> out;
  const Ground ground_before(before.clouds, before.missions, options, context);
  if (ground_before.cells().empty()) return out;
  const Ground ground_after(moved(after, T_before_after), after.missions, options, context);
  if (ground_after.cells().empty()) return out;
  const Grid grid = grid_around(ground_before, options.cell_size);
  const Rays rays_before(before, {}, grid, context),
      rays_after(after, T_before_after, grid, context);
  GroundOffsets offsets;
  for (int x = grid.low[0]; x <= grid.high[0]; ++x)
    for (int y = grid.low[1]; y <= grid.high[1]; ++y) {
      CellChange change{{x, y}, {}, {}, {}};
      if (const auto ground = ground_before.cells().find(change.cell);
          ground != ground_before.cells().end())
        change.level = ground->second.z();
      const auto known = ground_after.cells().find(change.cell);
      if (known != ground_after.cells().end() && change.level) {
        const Vec3& p = known->second;
        if (const auto z = ground_before.height(change.cell, p.x(), p.y()))
          change.ground = p.z() - *z;
      }
      if (change.ground) offsets.add(change.cell, *change.ground);
      change.canopy = canopy_change(rays_before, rays_after, *grid.index(x, y));
      if (change.ground || change.canopy) out.push_back(change);
    }
  for (CellChange& change : out)
    if (change.canopy) {
      const auto offset = offsets.around(change.cell);
      change.canopy = offset ? std::optional(*change.canopy - *offset) : std::nullopt;
    }
  std::erase_if(out, [](const CellChange& c) { return !c.ground && !c.canopy; });
  return out;
}

}  // namespace cambium::monitor
