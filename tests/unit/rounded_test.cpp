// SPDX-License-Identifier: BSD-3-Clause
#include "engine/rounded.hpp"

#include <random>

#include "support/support.hpp"

using namespace cambium;

TEST(Rounded, StaysNearAndIsTheSameForAlmostTheSame) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> any(-1, 1);
  std::size_t same = 0;
  for (int i = 0; i < 500; ++i) {
    Vec6 xi, nudge;
    for (int k = 0; k < 6; ++k) xi[k] = 1.7 * any(random), nudge[k] = 1e-3 * any(random);
    nudge.tail<3>() *= 0.1;
    const SE3 T = SE3::exp(xi), R = rounded(T);
    const SE3 off = T.inverse() * R;
    EXPECT_LE(off.t.norm(), 0.1 * std::sqrt(3.0) + 1e-12);
    EXPECT_LE(rotation_angle(off), 0.02);
    EXPECT_LT((rounded(R).t - R.t).norm(), 1e-12);
    const SE3 other = rounded(T * SE3::exp(nudge));
    same += other.t == R.t && other.q.coeffs() == R.q.coeffs();
  }
  EXPECT_GT(same, 400u);
}
