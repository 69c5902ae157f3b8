// SPDX-License-Identifier: BSD-3-Clause
#include "triangle_index.hpp"

#include <tuple>

namespace tree_match {
namespace {

/// Heights become 1..255, and 0 when not known.
int lane_of(std::int8_t dz) { return int(dz) + 128; }

}  // namespace

TriangleIndex::TriangleIndex(std::vector<Triangle> triangles, const IndexLimits& limits)
    : cell_(std::max(1, int(std::lround(1000 * limits.cell)))),
      max_side_(int(std::lround(1000 * limits.max_side_difference))),
      probe_(limits.probe),
      max_dbh_(int(std::lround(100 * limits.max_dbh_difference))),
      max_dz_(int(std::lround(20 * limits.max_height_difference))),
      triangles_(std::move(triangles)) {
  int longest = 0;  // of the middle sides
  for (const Triangle& t : triangles_) longest = std::max(longest, int(t.side[1]));
  rows_ = 1 + longest / cell_;
  sort(triangles_);
  begin_.assign(2 * std::size_t(rows_) * std::size_t(rows_) + 1, 0);
  for (const Triangle& t : triangles_) {
    ++begin_[row_of(t) + 1];
    longest_.push_back(t.side[2]);
    for (std::size_t k = 0; k < 2; ++k) {
      lane_[k].push_back(offset_in_cell(t.side[k], t.side[k] / cell_));
      lane_[5 + k].push_back(std::uint8_t(lane_of(t.dz[k])));
    }
    for (std::size_t k = 0; k < 3; ++k) lane_[2 + k].push_back(t.dbh[k]);
  }
  for (std::size_t i = 1; i < begin_.size(); ++i) begin_[i] += begin_[i - 1];
}

void TriangleIndex::sort(std::vector<Triangle>& triangles) const {
  std::stable_sort(triangles.begin(), triangles.end(), [&](const Triangle& s, const Triangle& t) {
    return std::tuple(row_of(s), s.side[2]) < std::tuple(row_of(t), t.side[2]);
  });
}

// A cell has 200 steps, 1..200 inside it.
std::uint8_t TriangleIndex::offset_in_cell(int side, int cell) const {
  return std::uint8_t(std::clamp(1 + 200 * (side - cell * cell_) / cell_, 1, 255));
}

TriangleIndex::Gates TriangleIndex::gates_of(const Triangle& query, int a, int b) const {
  Gates gates;
  const auto set = [&](std::size_t lane, int low, int high) {
    low = std::clamp(low, 1, 255);
    gates[lane] = {std::uint8_t(low), std::uint8_t(std::clamp(high, low, 255) - low)};
  };
  set(0, offset_in_cell(query.side[0] - max_side_, a),
      offset_in_cell(query.side[0] + max_side_, a));
  set(1, offset_in_cell(query.side[1] - max_side_, b),
      offset_in_cell(query.side[1] + max_side_, b));
  for (std::size_t k = 0; k < 3; ++k)
    if (query.dbh[k] != 0) set(2 + k, query.dbh[k] - max_dbh_, query.dbh[k] + max_dbh_);
  for (std::size_t k = 0; k < 2; ++k)
    if (const int dz = query.dz[k]; dz != Triangle::unknown_dz)
      set(5 + k, lane_of(query.dz[k]) - max_dz_, lane_of(query.dz[k]) + max_dz_);
  return gates;
}

TriangleIndex::Run TriangleIndex::run_of(const Triangle& query, int a, int b) const {
  const std::size_t row = row_of(query.clockwise, a, b);
  const Range c = cells(query.side[2]);
  const int low = std::max(c.low * cell_, query.side[2] - max_side_),
            high = std::min(c.high * cell_ - 1, query.side[2] + max_side_);
  const auto begin = longest_.begin() + std::ptrdiff_t(begin_[row]),
             end = longest_.begin() + std::ptrdiff_t(begin_[row + 1]);
  return {std::size_t(std::lower_bound(begin, end, low) - longest_.begin()),
          std::size_t(std::upper_bound(begin, end, high) - longest_.begin())};
}

void TriangleIndex::test(const Gates& gates, std::size_t first, std::size_t count,
                         std::uint8_t* passes) const {
  std::fill_n(passes, count, std::uint8_t(1));
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const Gate gate = gates[lane];
    if (gate.span == 255) continue;
    const std::uint8_t* value = lane_[lane].data() + first;
    for (std::size_t i = 0; i < count; ++i)
      passes[i] &= std::uint8_t(std::uint8_t(value[i] - gate.low) <= gate.span) |
                   std::uint8_t(value[i] == 0);
  }
}

}  // namespace tree_match
