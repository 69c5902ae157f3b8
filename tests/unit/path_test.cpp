// SPDX-License-Identifier: BSD-3-Clause
#include "cambium/path.hpp"

#include "support/support.hpp"

namespace cambium {
namespace {

TEST(Path, TravelledIsTheSumOfTheSteps) {
  const auto at = [](double x, double y) { return SE3{Quat::Identity(), Vec3(x, y, 0)}; };
  const Mission m = testing::make_mission("m", {at(0, 0), at(3, 4), at(3, 4), at(0, 0)});
  EXPECT_EQ(travelled(m), (std::vector<double>{0, 5, 5, 10}));
  EXPECT_TRUE(travelled(Mission{}).empty());
}

TEST(Path, SecondsKeepNanosecondsOfLateStamps) {
  const Stamp a{1700000000, 999999999}, b{1700000001, 1};
  EXPECT_NEAR(seconds_between(a, b), 2e-9, 1e-15);
  EXPECT_NEAR(seconds_between(b, a), -2e-9, 1e-15);
}

}  // namespace
}  // namespace cambium
