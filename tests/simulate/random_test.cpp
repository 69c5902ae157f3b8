// SPDX-License-Identifier: BSD-3-Clause
#include "simulate/random.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <set>

#include "simulate/diameters.hpp"

namespace cambium::simulate {
namespace {

constexpr int draws = 200000;

struct Moments {
  double mean = 0, sd = 0;
};
Moments moments_of(const std::function<double(Random&)>& draw) {
  Random r(42, "moments");
  double sum = 0, squares = 0;
  for (int i = 0; i < draws; ++i) {
    const double x = draw(r);
    sum += x, squares += x * x;
  }
  const double mean = sum / draws;
  return {mean, std::sqrt(squares / draws - mean * mean)};
}

// Five standard errors of a mean of 200000 draws are 1.1 % of the standard deviation.
TEST(Random, DistributionsHaveTheirMoments) {
  const auto uniform = moments_of([](Random& r) { return r.uniform(2, 6); });
  EXPECT_NEAR(uniform.mean, 4, 0.015);
  EXPECT_NEAR(uniform.sd, 4 / std::sqrt(12.0), 0.01);
  const auto normal = moments_of([](Random& r) { return r.normal(); });
  EXPECT_NEAR(normal.mean, 0, 0.012);
  EXPECT_NEAR(normal.sd, 1, 0.01);
  const auto exponential = moments_of([](Random& r) { return r.exponential(3); });
  EXPECT_NEAR(exponential.mean, 3, 0.04);
  EXPECT_NEAR(exponential.sd, 3, 0.06);
  const auto poisson = moments_of([](Random& r) { return double(r.poisson(2.5)); });
  EXPECT_NEAR(poisson.mean, 2.5, 0.02);
  EXPECT_NEAR(poisson.sd, std::sqrt(2.5), 0.02);
}

TEST(Random, NormalTailsAreThoseOfTheNormalDistribution) {
  const auto beyond = moments_of([](Random& r) { return double(std::abs(r.normal()) > 1.96); });
  EXPECT_NEAR(beyond.mean, 0.05, 0.0025);
}

TEST(Random, WeibullFromMeanAndDeviationGivesThemBack) {
  for (const auto& [mean, sd] : {std::pair{0.166, 0.094}, {0.25, 0.08}, {0.166, 0.02}}) {
    const Weibull w = weibull_from(mean, sd);
    const auto m = moments_of([&](Random& r) { return r.weibull(w.shape, w.scale); });
    EXPECT_NEAR(m.mean, mean, 0.012 * sd);
    EXPECT_NEAR(m.sd, sd, 0.015 * sd);
  }
  EXPECT_NEAR(weibull_from(0.166, 0.094).shape, 1.83, 0.02);  // an exponential would have 1
  EXPECT_NEAR(weibull_from(1, 1).shape, 1, 1e-9);
}

TEST(Random, StreamsDependOnEveryKeyAndOnNothingElse) {
  EXPECT_EQ(Random(1, "a", 2, 3).next(), Random(1, "a", 2, 3).next());
  std::set<std::uint64_t> first;
  for (const std::uint64_t seed : {0, 1, 2})
    for (const char* purpose : {"a", "b"})
      for (const int key : {0, 1, 2}) {
        const Random r(seed, purpose, key);
        first.insert(Random(r).next());
        for (const std::uint64_t item : {0, 1, 2}) first.insert(r.fork(item).next());
      }
  EXPECT_EQ(first.size(), 3u * 2 * 3 * 4);
}

TEST(Random, NeighbouringForksAreUncorrelated) {
  const Random stream(7, "forks");
  double product = 0;
  for (int i = 0; i < draws; ++i) {
    Random a = stream.fork(std::uint64_t(i)), b = stream.fork(std::uint64_t(i) + 1);
    product += (a.uniform() - 0.5) * (b.uniform() - 0.5) * 12;
  }
  EXPECT_NEAR(product / draws, 0, 5 / std::sqrt(double(draws)));
}

// Computed by an independent implementation: seeds of old specifications must keep their meaning.
TEST(Random, GoldenSequence) {
  Random r(1, "golden");
  const std::uint64_t a = r.next(), b = r.next();
  EXPECT_EQ(a, 10518711902537225993u);
  EXPECT_EQ(b, 8830545786349578813u);
}

}  // namespace
}  // namespace cambium::simulate
