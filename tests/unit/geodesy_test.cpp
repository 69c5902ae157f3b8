// SPDX-License-Identifier: BSD-3-Clause
#include "cambium/geodesy.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "cambium/error.hpp"

namespace cambium {
namespace {

// Golden values: geodetic -> ECEF -> ENU by the textbook formulas of WGS 84, computed apart.
TEST(Geodesy, AgreesWithTheTextbookFormulas) {
  const struct {
    Geodetic reference, point;
    Vec3 p_enu;
  } golden[] = {
      {{61.2, 25.1, 130}, {61.245, 25.1, 130}, {0.0, 5014.577816343, -1.969222401}},
      {{61.2, 25.1, 130}, {61.2, 25.19, 150}, {4839.137178225, 3.330535188, 18.169022786}},
      {{-33.8, 151.2, 20}, {-33.9, 151.1, -5}, {-9249.278327610, -11096.443761188, -41.386892034}},
      {{0, 179.9995, 0}, {0, -179.9995, 10}, {111.319665320, 0.0, 9.999028553}},  // date line
  };
  for (const auto& g : golden) {
    EXPECT_LT((to_enu(g.reference, g.point) - g.p_enu).norm(), 1e-6);
  }
}

TEST(Geodesy, ComesBackFromEnu) {
  const Geodetic reference{51.7520, -1.2577, 63.0};
  for (const Vec3& p : {Vec3(0, 0, 0), Vec3(12345.6, -6543.2, 100), Vec3(-3, 5, -50)}) {
    EXPECT_LT((to_enu(reference, from_enu(reference, p)) - p).norm(), 1e-8);
  }
}

TEST(Geodesy, MapPointsGoThroughTheInverseOfTMapEnu) {
  const GeoReference g{47.0, 8.0, 400.0, SE3::from_yaw(0.7, {10, -20, 3}), 0, 0};
  const Vec3 p_enu(120, -45, 6);
  const Geodetic point = map_to_geodetic(g, g.T_map_enu * p_enu);
  EXPECT_LT((to_enu({47.0, 8.0, 400.0}, point) - p_enu).norm(), 1e-8);
}

TEST(Geodesy, RefusesWhatIsNoPlaceOnTheGlobe) {
  const Geodetic good{10, 20, 30};
  EXPECT_THROW(to_enu({90.5, 0, 0}, good), Error);
  EXPECT_THROW(to_enu(good, {std::numeric_limits<double>::quiet_NaN(), 0, 0}), Error);
  EXPECT_THROW(from_enu({0, std::numeric_limits<double>::infinity(), 0}, Vec3::Zero()), Error);
}

}  // namespace
}  // namespace cambium
