// SPDX-License-Identifier: BSD-3-Clause
#include "matrix/mann_whitney.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

namespace cambium::matrix {
namespace {

// The definition: of all ways to deal the values into two samples, how many are at least as far
// from the middle as the one seen.
double by_enumeration(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> all = a;
  all.insert(all.end(), b.begin(), b.end());
  std::vector<int> mask(all.size(), 0);
  std::fill(mask.end() - std::ptrdiff_t(a.size()), mask.end(), 1);
  const auto distance = [&](const std::vector<int>& m) {
    double u = 0;
    for (std::size_t i = 0; i < all.size(); ++i)
      for (std::size_t j = 0; j < all.size(); ++j)
        if (m[i] == 1 && m[j] == 0) u += all[i] > all[j];
    return std::abs(u - double(a.size() * b.size()) / 2);
  };
  std::vector<int> seen(all.size(), 0);
  std::fill(seen.begin(), seen.begin() + std::ptrdiff_t(a.size()), 1);
  const double limit = distance(seen);
  int count = 0, extreme = 0;
  do {
    ++count;
    extreme += distance(mask) >= limit;
  } while (std::next_permutation(mask.begin(), mask.end()));
  return double(extreme) / count;
}

TEST(MannWhitney, KnownValues) {
  EXPECT_NEAR(mann_whitney_p({1, 2, 3, 4}, {5, 6, 7, 8}), 2.0 / 70, 1e-12);
  EXPECT_NEAR(mann_whitney_p({1, 2, 3}, {4, 5, 6}), 2.0 / 20, 1e-12);
  EXPECT_EQ(mann_whitney_p({1}, {2}), 1);
  EXPECT_EQ(mann_whitney_p({}, {1, 2}), 1);
}

TEST(MannWhitney, IsTheShareOfMoreExtremeOrders) {
  std::mt19937 random(1);
  std::vector<double> values(11);
  std::iota(values.begin(), values.end(), 1.0);
  for (int trial = 0; trial < 20; ++trial) {
    std::shuffle(values.begin(), values.end(), random);
    const auto split = values.begin() + 3 + trial % 5;
    const std::vector<double> a(values.begin(), split), b(split, values.end());
    EXPECT_NEAR(mann_whitney_p(a, b), by_enumeration(a, b), 1e-12);
    EXPECT_NEAR(mann_whitney_p(a, b), mann_whitney_p(b, a), 1e-12);
  }
}

TEST(MannWhitney, TiesUseTheNormalApproximation) {
  EXPECT_EQ(mann_whitney_p({1, 1, 1, 1}, {1, 1, 1, 1}), 1);
  // z = (|9 - 18| - 0.5) / sqrt(36 / 12 * (13 - (3 * 6) / 132)), p = erfc(z / sqrt 2)
  const std::vector<double> a = {1, 2, 3, 4, 5, 6}, b = {4, 5, 6, 7, 8, 9};
  const double u = 4.5, sigma = std::sqrt(36.0 / 12 * (13 - 18.0 / 132));
  EXPECT_NEAR(mann_whitney_p(a, b), std::erfc((18 - u - 0.5) / sigma / std::sqrt(2.0)), 1e-12);
}

TEST(MannWhitney, ManyValuesOfOneDistributionAreRarelyTakenForTwo) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  int moved = 0;
  for (int trial = 0; trial < 400; ++trial) {
    std::vector<double> a(8), b(8);
    for (double& x : a) x = normal(random);
    for (double& x : b) x = normal(random);
    moved += mann_whitney_p(a, b) < 0.05;
  }
  EXPECT_LT(moved, 32);  // 5 % of 400 is 20, with a standard deviation of 4.4
}

}  // namespace
}  // namespace cambium::matrix
