// SPDX-License-Identifier: BSD-3-Clause
// Summaries that plugins report, defined once so that their figures can be compared.
#pragma once
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace cambium {

/// Of an even number of values the mean of the middle two; NaN of none.
inline double median(std::vector<double> values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 ? values[half] : (values[half - 1] + values[half]) / 2;
}

/// Root mean square; NaN of none.
inline double rms(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v * v;
  return std::sqrt(sum / double(values.size()));
}

}  // namespace cambium
