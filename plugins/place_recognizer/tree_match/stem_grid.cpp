// SPDX-License-Identifier: BSD-3-Clause
#include "stem_grid.hpp"

namespace tree_match {

StemGrid::StemGrid(std::span<const Stem> stems) : begin_(2, 0) {
  if (stems.empty()) return;
  constexpr float finest = 1.0f, most = 4000.0f;  // [m] a cell; cells a side
  float x_high = x_low_ = stems[0].x, y_high = y_low_ = stems[0].y;
  for (const Stem& s : stems) {
    x_low_ = std::min(x_low_, s.x), x_high = std::max(x_high, s.x);
    y_low_ = std::min(y_low_, s.y), y_high = std::max(y_high, s.y);
  }
  per_metre_ = 1 / std::max({finest, (x_high - x_low_) / most, (y_high - y_low_) / most});
  columns_ = 1 + int((x_high - x_low_) * per_metre_);
  rows_ = 1 + int((y_high - y_low_) * per_metre_);
  const auto cell_of = [&](const Stem& s) {
    return cell(clamped(s.x - x_low_, columns_), clamped(s.y - y_low_, rows_));
  };
  begin_.assign(std::size_t(columns_) * std::size_t(rows_) + 1, 0);
  for (const Stem& s : stems) ++begin_[cell_of(s) + 1];
  for (std::size_t i = 1; i < begin_.size(); ++i) begin_[i] += begin_[i - 1];
  std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
  entries_.resize(stems.size());
  for (std::uint32_t i = 0; i < stems.size(); ++i)
    entries_[next[cell_of(stems[i])]++] = {stems[i].x, stems[i].y, i};
}

}  // namespace tree_match
