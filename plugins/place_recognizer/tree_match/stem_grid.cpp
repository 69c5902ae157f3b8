// SPDX-License-Identifier: BSD-3-Clause
#include "stem_grid.hpp"

#include <tuple>

namespace tree_match {

StemGrid::StemGrid(std::span<const Stem> stems) : begin_(1, 0) {
  if (stems.empty()) return;
  const auto [low, high] = std::minmax_element(
      stems.begin(), stems.end(), [](const Stem& a, const Stem& b) { return a.y < b.y; });
  y_low_ = low->y;
  rows_ = 1 + int((high->y - y_low_) / row_height);
  for (std::size_t i = 0; i < stems.size(); ++i)
    entries_.push_back({stems[i].x, stems[i].y, std::uint32_t(i)});
  const auto order = [&](const Entry& e) { return std::tuple(row_of(e.y), e.x, e.stem); };
  std::sort(entries_.begin(), entries_.end(),
            [&](const Entry& a, const Entry& b) { return order(a) < order(b); });
  begin_.assign(std::size_t(rows_) + 1, 0);
  for (const Entry& e : entries_) ++begin_[std::size_t(row_of(e.y)) + 1];
  for (std::size_t row = 0; row < std::size_t(rows_); ++row) begin_[row + 1] += begin_[row];
}

}  // namespace tree_match
