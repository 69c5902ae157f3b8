// SPDX-License-Identifier: BSD-3-Clause
#include "engine/rounded.hpp"

#include <cmath>

namespace cambium {

SE3 rounded(const SE3& T) {
  constexpr double metres = 0.2, radians = 0.02;
  SE3 turn;
  turn.q = T.q;
  Vec6 xi = turn.log();
  xi.head<3>().setZero();
  for (int k = 3; k < 6; ++k) xi[k] = radians * std::round(xi[k] / radians);
  SE3 out = SE3::exp(xi);
  for (int k = 0; k < 3; ++k) out.t[k] = metres * std::round(T.t[k] / metres);
  return out;
}

}  // namespace cambium
