// SPDX-License-Identifier: BSD-3-Clause
#include "common/block_index.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace cambium::registration {

struct BlockIndex::Search {
  Eigen::Vector3f query;
  float margin;
  Nearest best;
  float bound;  ///< points farther than this change nothing, squared
  Eigen::Array3i place;
  std::int32_t block;        ///< at that place, -1 when empty
  Eigen::Array3f low, high;  ///< from the query to the faces of its block [m]

  void shrink() {
    const float reach = std::sqrt(best.squared) + margin;
    bound = std::min(best.others, reach * reach);
  }
};

BlockIndex::BlockIndex(const Thinned& cloud)
    : width_(float(4 * cloud.voxel_size)),
      mask_(std::bit_ceil(std::uint32_t(2 * cloud.blocks.size() + 1)) - 1),
      slots_(mask_ + 1, -1),
      places_(cloud.blocks),
      first_(cloud.first.begin(), cloud.first.end()) {
  for (std::size_t b = 0; b < places_.size(); ++b) {
    std::uint32_t slot = hash(places_[b]) & mask_;
    while (slots_[slot] >= 0) slot = (slot + 1) & mask_;
    slots_[slot] = std::int32_t(b);
  }
  around_.resize(places_.size());
  for (std::size_t b = 0; b < places_.size(); ++b)
    for (int i = 0; i < 27; ++i)
      around_[b][std::size_t(i)] =
          find(places_[b] + Eigen::Array3i(i / 9 - 1, i / 3 % 3 - 1, i % 3 - 1));
  for (const Eigen::Vector3f& p : cloud.points) {
    x_.push_back(p.x());
    y_.push_back(p.y());
    z_.push_back(p.z());
  }
}

void BlockIndex::scan(std::int32_t block, Search& search) const {
  const std::uint32_t first = first_[std::size_t(block)];
  const std::uint32_t count = first_[std::size_t(block) + 1] - first;
  const float x = search.query.x(), y = search.query.y(), z = search.query.z();
  std::array<float, 64> squared;
  for (std::uint32_t i = 0; i < count; ++i) {  // the compiler takes four at a time
    const float dx = x_[first + i] - x, dy = y_[first + i] - y, dz = z_[first + i] - z;
    squared[i] = dx * dx + dy * dy + dz * dz;
  }
  Nearest& best = search.best;
  const std::int32_t before = best.index;
  for (std::uint32_t i = 0; i < count; ++i) {
    if (!(squared[i] < best.others)) continue;
    const bool nearer = squared[i] < best.squared;
    best.others = nearer ? best.squared : squared[i];
    if (!nearer) continue;
    best.squared = squared[i];
    best.index = std::int32_t(first + i);
  }
  if (best.index != before) search.shrink();
}

// The blocks `shell` away from the query's that are near enough.
void BlockIndex::scan_shell(int shell, Search& s) const {
  const auto gap = [&](int k, int step) {  // to the slab `step` blocks away along axis k, squared
    const float side = step < 0 ? s.low[k] : s.high[k];
    const float d = step == 0 ? 0.0F : side + float(std::abs(step) - 1) * width_;
    return d * d;
  };
  for (int x = -shell; x <= shell; ++x) {
    const float gap_x = gap(0, x);
    if (!(gap_x < s.bound)) continue;
    for (int y = -shell; y <= shell; ++y) {
      const float gap_xy = gap_x + gap(1, y);
      if (!(gap_xy < s.bound)) continue;
      const bool side = std::max(std::abs(x), std::abs(y)) == shell;
      for (int z = -shell; z <= shell; z += side ? 1 : 2 * shell) {
        if (!(gap_xy + gap(2, z) < s.bound)) continue;
        const std::int32_t b = shell == 1 && s.block >= 0
                                   ? around(std::size_t(s.block), x + 1, y + 1, z + 1)
                                   : find(s.place + Eigen::Array3i(x, y, z));
        if (b >= 0) scan(b, s);
      }
    }
  }
}

Nearest BlockIndex::nearest(const Eigen::Vector3f& query, float radius, float margin) const {
  const float limit = radius * radius;
  Search s{query, margin, {-1, limit, limit}, limit, {}, -1, {}, {}};
  const Eigen::Array3f scaled = query.array() / width_;
  // Outside of all blocks, and an int could not hold the place.
  if (!(scaled.abs() < float(1 << 19)).all()) return s.best;
  const Eigen::Array3f corner = scaled.floor();
  s.place = corner.cast<int>();
  s.low = (scaled - corner) * width_;
  s.high = width_ - s.low;
  s.block = find(s.place);
  if (s.block >= 0) scan(s.block, s);
  const int reach = int(std::ceil(radius / width_));
  for (int shell = 1; shell <= reach; ++shell) scan_shell(shell, s);
  s.best.others = std::min(s.best.others, s.bound);
  return s.best;
}

}  // namespace cambium::registration
