// SPDX-License-Identifier: BSD-3-Clause
// A query as the kernels read it, and how far the sums that they make of it may be off.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "common/filled.hpp"
#include "common/spectrum.hpp"

namespace columns {

/// What does not depend on the query: from cross spectra to shifts, by symmetry for half of them.
struct InverseTransform {
  explicit InverseTransform(Shape shape);
  Shape shape;
  std::vector<float> cosine, sine;  ///< [sectors / 2 + 4][frequencies]: kernels read four at once
};

/// One descriptor in seven bits a number. With R the codes of a reference less 128,
///   cross(f) = gain(f) * scale(f) * (sum of codes(f, 0) R, sum of codes(f, 1) R)
/// is weight(f) / sectors * conj(Q_f) . R_f, up to the rounding of both.
struct CoarseQuery {
  CoarseQuery(std::span<const float> descriptor, const Transform& transform);

  std::vector<std::int8_t> codes;     ///< [frequencies][2][4 groups]: for the real, imaginary part
  std::vector<std::int32_t> offsets;  ///< [frequencies][2]: - 128 times the sum of the codes
  std::vector<float> gains;           ///< [frequencies]
  int filled = 0;                     ///< number of filled columns
  Overlap overlap;
  /// |S(k) - what a kernel finds| <= per_error * error(reference) + per_norm * norm(reference).
  float per_error = 0, per_norm = 0;
};

}  // namespace columns
