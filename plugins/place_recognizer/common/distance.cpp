// SPDX-License-Identifier: BSD-3-Clause
#include "common/distance.hpp"

namespace columns {
namespace {

double cosine(const float* a, const float* b, int rings) {
  double sum = 0;
  for (int i = 0; i < rings; ++i) sum += double(a[i]) * double(b[i]);
  return sum;
}

}  // namespace

double correlation(std::span<const float> query, std::span<const float> reference, Shape shape,
                   std::size_t shift) {
  const auto rings = std::size_t(shape.rings), sectors = std::size_t(shape.sectors);
  double sum = 0;
  for (std::size_t s = 0; s < sectors; ++s)
    sum += cosine(&query[s * rings], &reference[(s + shift) % sectors * rings], shape.rings);
  return sum;
}

}  // namespace columns
