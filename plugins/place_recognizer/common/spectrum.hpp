// SPDX-License-Identifier: BSD-3-Clause
// The discrete Fourier transform over the sectors: turning becomes a phase, so that S(k) needs one
// product a frequency and ring instead of one a shift, sector and ring.
//   S(k) = sum over f of weight(f) / sectors * Re(exp(2 pi i f k / sectors) conj(Q_f) . R_f)
#pragma once
#include <span>
#include <vector>

#include <Eigen/Core>

#include "common/shape.hpp"

namespace columns {

/// cos and sin of 2 pi f s / sectors, for any product f s.
class Turns {
 public:
  explicit Turns(Shape shape);
  double cosine(std::size_t product) const { return cosine_[product % cosine_.size()]; }
  double sine(std::size_t product) const { return sine_[product % sine_.size()]; }

 private:
  std::vector<double> cosine_, sine_;
};

/// 2 for a frequency that stands for its mirror as well, else 1.
double weight(Shape shape, std::size_t frequency);

class Transform {
 public:
  explicit Transform(Shape shape);
  Shape shape() const { return shape_; }
  /// 2 rings x frequencies: real parts above imaginary parts. `descriptor` is column by column.
  Eigen::MatrixXd operator()(std::span<const float> descriptor) const;

 private:
  Shape shape_;
  Eigen::MatrixXd cosine_, sine_;  // sectors x frequencies
};

/// Length of a descriptor, from its spectrum (Parseval). |S(k)| <= norm(query) * norm(reference).
double norm(Shape shape, const Eigen::MatrixXd& spectrum);

}  // namespace columns
