// SPDX-License-Identifier: BSD-3-Clause
#include "common/spectrum.hpp"

#include <cmath>
#include <numbers>

namespace columns {

Turns::Turns(Shape shape) {
  for (int s = 0; s < shape.sectors; ++s) {
    cosine_.push_back(std::cos(2.0 * std::numbers::pi * s / shape.sectors));
    sine_.push_back(std::sin(2.0 * std::numbers::pi * s / shape.sectors));
  }
}

double weight(Shape shape, std::size_t frequency) {
  return frequency == 0 || 2 * frequency == std::size_t(shape.sectors) ? 1.0 : 2.0;
}

Transform::Transform(Shape shape)
    : shape_(shape),
      cosine_(shape.sectors, shape.frequencies()),
      sine_(shape.sectors, shape.frequencies()) {
  const Turns turns(shape);
  for (std::size_t f = 0; f < shape.frequencies(); ++f)
    for (int s = 0; s < shape.sectors; ++s) {
      cosine_(s, Eigen::Index(f)) = turns.cosine(f * std::size_t(s));
      sine_(s, Eigen::Index(f)) = -turns.sine(f * std::size_t(s));
    }
}

Eigen::MatrixXd Transform::operator()(std::span<const float> descriptor) const {
  const Eigen::MatrixXd columns =
      Eigen::Map<const Eigen::MatrixXf>(descriptor.data(), shape_.rings, shape_.sectors)
          .cast<double>();
  Eigen::MatrixXd out(2 * shape_.rings, cosine_.cols());
  out.topRows(shape_.rings).noalias() = columns * cosine_;
  out.bottomRows(shape_.rings).noalias() = columns * sine_;
  return out;
}

double norm(Shape shape, const Eigen::MatrixXd& spectrum) {
  double sum = 0;
  for (std::size_t f = 0; f < shape.frequencies(); ++f)
    sum += weight(shape, f) * spectrum.col(Eigen::Index(f)).squaredNorm();
  return std::sqrt(sum / shape.sectors);
}

}  // namespace columns
