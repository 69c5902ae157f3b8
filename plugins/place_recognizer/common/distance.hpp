// SPDX-License-Identifier: BSD-3-Clause
// The definition that every search result is measured by: floats in, sums in double, in the order
// of rings and then sectors, so that equal descriptors have equal distances.
#pragma once
#include <limits>
#include <span>

#include "common/filled.hpp"

namespace columns {

/// S(shift) of the definition in shape.hpp.
double correlation(std::span<const float> query, std::span<const float> reference, Shape shape,
                   std::size_t shift);

/// d(shift); infinite when fewer than `least_columns` (at least 1) are filled in both.
inline double distance(double correlation, int columns_in_common, double least_columns) {
  if (columns_in_common < least_columns) return std::numeric_limits<double>::infinity();
  const double d = 1.0 - correlation / columns_in_common;
  return d > 0.0 ? d : 0.0;
}

}  // namespace columns
