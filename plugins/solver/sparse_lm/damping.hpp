// SPDX-License-Identifier: BSD-3-Clause
// How far a step is trusted: H. B. Nielsen, "Damping parameter in Marquardt's method",
// IMM-REP-1999-05, equation (2.21).
#pragma once
#include <algorithm>
#include <cmath>

namespace cambium::sparse_lm {

class Damping {
 public:
  double value() const { return value_; }  ///< a fraction of the diagonal of H

  /// After a step that lowered the cost by `gain` times what its model said.
  void relax(double gain) {
    value_ = std::max(least, value_ * std::max(1.0 / 3, 1 - std::pow(2 * gain - 1, 3)));
    growth_ = 2;
  }
  /// After one that did not. False: no step is short enough.
  bool tighten() {
    value_ = std::max(after_first_failure, value_ * growth_);
    growth_ *= 2;
    return value_ < most;
  }

 private:
  // The chordal start is good, so the first step is nearly that of Gauss and Newton; what remains
  // keeps directions that no factor holds from being singular.
  static constexpr double least = 1e-12, after_first_failure = 1e-5, most = 1e12;
  double value_ = least, growth_ = 2;
};

}  // namespace cambium::sparse_lm
