// SPDX-License-Identifier: BSD-3-Clause
#include "common/coarse_query.hpp"

#include <algorithm>
#include <cmath>

namespace columns {
namespace {

// Two products of a reference's byte and a query's code fit in 16 signed bits: 2 * 255 * 63 < 2^15.
constexpr double largest_code = 63.0;

/// How far float sums over all frequencies may be off, relative to the norms of the pair.
double rounding(Shape shape) { return std::ldexp(2.0 * double(shape.frequencies()) + 32.0, -23); }

}  // namespace

InverseTransform::InverseTransform(Shape s)
    : shape(s), cosine((std::size_t(s.sectors) / 2 + 4) * s.frequencies()), sine(cosine.size()) {
  const Turns turns(shape);
  for (std::size_t k = 0; k < std::size_t(shape.sectors) / 2 + 4; ++k)
    for (std::size_t f = 0; f < shape.frequencies(); ++f) {
      cosine[k * shape.frequencies() + f] = float(turns.cosine(f * k));
      sine[k * shape.frequencies() + f] = float(turns.sine(f * k));
    }
}

CoarseQuery::CoarseQuery(std::span<const float> descriptor, const Transform& transform)
    : overlap(filled_columns(descriptor, transform.shape()), transform.shape()) {
  const Shape shape = transform.shape();
  const std::size_t width = 4 * shape.groups(), rings = std::size_t(shape.rings);
  codes.assign(shape.frequencies() * 2 * width, 0);
  offsets.assign(shape.frequencies() * 2, 0);
  gains.assign(shape.frequencies(), 0.0f);
  filled = count_bits(filled_columns(descriptor, shape));

  Eigen::MatrixXd missed = transform(descriptor);
  const double whole = norm(shape, missed);
  for (std::size_t f = 0; f < shape.frequencies(); ++f) {
    auto column = missed.col(Eigen::Index(f));
    const double scale = column.cwiseAbs().maxCoeff() / largest_code;
    gains[f] = float(scale * weight(shape, f) / shape.sectors);
    if (!(scale > 0)) continue;
    std::int8_t* real = codes.data() + f * 2 * width;  // conj(Q) R = (a - ib)(c + id)
    std::int8_t* imaginary = real + width;
    for (std::size_t i = 0; i < 2 * rings; ++i) {
      const double code = std::nearbyint(column[Eigen::Index(i)] / scale);
      real[i] = std::int8_t(code);
      (i < rings ? imaginary[i + rings] : imaginary[i - rings]) =
          std::int8_t(i < rings ? code : -code);
      column[Eigen::Index(i)] -= code * scale;
    }
    for (std::size_t i = 0; i < width; ++i) {
      offsets[2 * f] -= 128 * real[i];
      offsets[2 * f + 1] -= 128 * imaginary[i];
    }
  }
  const double error = norm(shape, missed);
  // S - found = <rounded query, error of the reference> + <error of the query, reference>.
  per_error = float((whole + error) * (1.0 + 1e-3));
  per_norm = float(error * (1.0 + 1e-6) + rounding(shape) * (whole + error));
}

}  // namespace columns
