// SPDX-License-Identifier: BSD-3-Clause
#include "simulate/stand.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "cambium/error.hpp"
#include "simulate/angles.hpp"
#include "simulate/diameters.hpp"
#include "simulate/pattern.hpp"

namespace cambium::simulate {
namespace {

Terrain level_ground(const StandSpec& s) {
  TerrainSpec t;
  t.max_slope = t.roughness = 0;
  return make_terrain(t, s.size, 1);
}

double nearest_distance(const std::vector<Stem>& stems, std::size_t i) {
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t j = 0; j < stems.size(); ++j)
    if (j != i) best = std::min(best, (stems[i].base - stems[j].base).norm());
  return best;
}
double least_distance(const std::vector<Stem>& stems) {
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < stems.size(); ++i) best = std::min(best, nearest_distance(stems, i));
  return best;
}

TEST(Stand, MaternKeepsDensityAndHardCore) {
  struct Case {
    double density, hard_core;
  };
  for (const Case c : {Case{195, 1.2}, {940, 1.1}, {2100, 1.0}, {3242, 0.8}}) {
    StandSpec s;
    s.size = {200, 200};
    s.density = c.density, s.hard_core = c.hard_core;
    const auto stems = plant(s, level_ground(s), 5);
    const double found = double(stems.size()) / 4.0;  // of 4 ha
    // Thinned points vary less than Poisson's, whose standard deviation is sqrt(n).
    EXPECT_NEAR(found, c.density, 3 * std::sqrt(c.density * 4) / 4);
    EXPECT_GE(least_distance(stems), c.hard_core);
  }
}

TEST(Stand, ADenserStandThanTheHardCoreAllowsIsRefused) {
  StandSpec s;
  s.density = 3242, s.hard_core = 1.1;
  EXPECT_NE(s.check_params().find("lower one"), std::string::npos);
}

TEST(Stand, LargerAreaKeepsTheStemsOfTheSmallerOne) {
  StandSpec s;
  s.size = {40, 40};
  const auto small = stem_places(s, 3);
  s.size = {80, 80};
  const auto large = stem_places(s, 3);
  int missing = 0;
  for (const Place& p : small) {
    // Beside the border, a neighbour from outside may win now.
    if (std::max(std::abs(p.x), std::abs(p.y)) > 20 - s.hard_core) continue;
    missing += std::none_of(large.begin(), large.end(),
                            [&](const Place& q) { return q.x == p.x && q.y == p.y; });
  }
  EXPECT_GT(small.size(), 100u);
  EXPECT_EQ(missing, 0);
}

TEST(Stand, ClusteredHasTheDensityTheHardCoreAndClusters) {
  StandSpec s;
  s.size = {150, 150};
  const auto random = plant(s, level_ground(s), 2);
  s.pattern = "clustered";
  const auto stems = plant(s, level_ground(s), 2);
  EXPECT_EQ(stems.size(), std::size_t(std::lround(940 * 2.25)));
  EXPECT_GE(least_distance(stems), s.hard_core);
  // Counts in squares of 10 m vary more in a clustered stand than in a random one.
  const auto variance = [](const std::vector<Stem>& all) {
    std::vector<double> counts(225);
    for (const Stem& t : all)
      counts[std::size_t((t.base.x() + 75) / 10) * 15 + std::size_t((t.base.y() + 75) / 10)]++;
    const double mean = double(all.size()) / 225;
    double sum = 0;
    for (const double c : counts) sum += (c - mean) * (c - mean);
    return sum / 225;
  };
  EXPECT_GT(variance(stems), 1.5 * variance(random));
}

TEST(Stand, DiametersHeightsAndLeanAreThoseAskedFor) {
  StandSpec s;
  s.size = {250, 250};
  const auto stems = plant(s, level_ground(s), 8);
  double sum = 0, squares = 0, lean = 0, height = 0;
  for (const Stem& t : stems) {
    sum += t.dbh, squares += t.dbh * t.dbh;
    lean += std::pow(std::atan2(t.axis.x(), t.axis.z()), 2);
    if (std::abs(t.dbh - 0.2) < 0.01) height += t.height - naslund_height(t.dbh, 1.2, 0.19);
  }
  const double n = double(stems.size()), mean = sum / n;
  EXPECT_NEAR(mean, 0.166, 0.005);
  EXPECT_NEAR(std::sqrt(squares / n - mean * mean), 0.094, 0.004);
  EXPECT_NEAR(std::sqrt(lean / n), radians(2), radians(0.08));
  EXPECT_NEAR(height / n, 0, 0.1);
}

TEST(Stand, ThickTreesKeepTheirDistanceAndTheDiametersStayTheSame) {
  StandSpec s;
  auto stems = plant(s, level_ground(s), 3);
  s.dominance = 0;
  auto by_chance = plant(s, level_ground(s), 3);
  const auto thickest = [](std::vector<Stem>& all) {
    std::sort(all.begin(), all.end(), [](const Stem& a, const Stem& b) { return a.dbh > b.dbh; });
    return std::vector<Stem>(all.begin(), all.begin() + std::ptrdiff_t(all.size() / 3));
  };
  EXPECT_GE(least_distance(thickest(stems)), 2.8);
  EXPECT_LT(least_distance(thickest(by_chance)), 2);
  for (std::size_t i = 0; i < stems.size(); ++i) EXPECT_EQ(stems[i].dbh, by_chance[i].dbh);
}

TEST(Stand, NaslundGolden) {
  // d = 20 cm, a = 1, b = 0.2: 1.3 + 400 / (1 + 4)^2
  EXPECT_DOUBLE_EQ(naslund_height(0.20, 1, 0.2), 17.3);
}

TEST(Stand, StemHasItsDiameterAtBreastHeightAndEndsInAPoint) {
  Stem s;
  s.dbh = 0.3, s.height = 20;
  EXPECT_DOUBLE_EQ(s.radius_at(1.3), 0.15);
  EXPECT_GT(s.radius_at(0), 0.15);
  EXPECT_EQ(s.radius_at(20), 0);
}

TEST(Stand, HarvestTakesItsShareAndALargerOneTakesMore) {
  StandSpec s;
  const auto stems = plant(s, level_ground(s), 1);
  const auto after30 = after_harvest(stems, 0.3, 1), after50 = after_harvest(stems, 0.5, 1);
  EXPECT_NEAR(double(after30.size()) / double(stems.size()), 0.7, 0.05);
  EXPECT_EQ(after_harvest(stems, 0, 1).size(), stems.size());
  EXPECT_TRUE(after_harvest(stems, 1, 1).empty());
  for (const Stem& t : after50)
    EXPECT_TRUE(std::any_of(after30.begin(), after30.end(),
                            [&](const Stem& u) { return u.mark == t.mark; }));
}

TEST(Terrain, SteepestSlopeIsTheOneAskedForAndHeightsAreContinuous) {
  TerrainSpec spec;
  spec.max_slope = 20, spec.roughness = 0;
  const Terrain t = make_terrain(spec, {120, 90}, 4);
  double steepest = 0;
  for (double x = -59.5; x < 59; ++x)
    for (double y = -44.5; y < 44; ++y) {
      const double dx = t.height(x + 0.5, y) - t.height(x - 0.5, y);
      const double dy = t.height(x, y + 0.5) - t.height(x, y - 0.5);
      steepest = std::max(steepest, std::hypot(dx, dy));
      EXPECT_NEAR(t.height(x + 1e-7, y), t.height(x - 1e-7, y), 1e-6);
    }
  EXPECT_NEAR(steepest, std::tan(radians(20)), 0.02);
}

}  // namespace
}  // namespace cambium::simulate
