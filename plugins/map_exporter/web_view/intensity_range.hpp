// SPDX-License-Identifier: BSD-3-Clause
// Between which intensities a map's points lie, whatever unit their sensors had.
#pragma once
#include <cstddef>
#include <utility>
#include <vector>

namespace web_view {

/// Counts values by their upper 16 bits (8 of them the mantissa's), so within 0.4 %.
class IntensityRange {
 public:
  void add(float intensity);  ///< negative values and NaN are left out
  /// From the 1st to the 99th percentile; {0, 0} when all are zero or there was none.
  std::pair<float, float> range() const;

 private:
  std::vector<std::size_t> counts_ = std::vector<std::size_t>(1 << 15);
  std::size_t total_ = 0;
};

}  // namespace web_view
