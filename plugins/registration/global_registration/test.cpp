// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <limits>
#include <thread>

#include "common/registration_laws.hpp"

namespace cambium::testing {

// The laws ask for parameters of the search around a guess; here only their helpers are used.
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(RegistrationLaws);

namespace {

const SE3 nowhere = SE3::from_yaw(2, {500, -300, 40});  // a guess that says nothing

Alignment align(const Registration& method, const Cloud& target, const Cloud& source,
                const SE3& guess = nowhere) {
  const auto context = make_context();
  const auto prepare = [&](const Cloud& c) {
    return method.prepare({std::make_shared<const Cloud>(c), nullptr}, *context);
  };
  return method.align(prepare(target), prepare(source), guess, *context);
}

TEST(GlobalRegistration, FindsAnyHeadingWithoutAGuess) {
  const auto method = component<Registration>("global_registration");
  const SE3 T_world_a = motion(1, -2, 1.5, 0.03, -0.02, 0.4);
  const Cloud a = forest_scan(T_world_a);
  for (const double yaw : {-3.0, -1.2, 0.1, 1.9, 3.1}) {
    const SE3 T_world_b = SE3::from_yaw(yaw, {4, 3, 1.8}) * motion(0, 0, 0, -0.04, 0.05, 0);
    const Alignment found = align(*method, a, forest_scan(T_world_b));
    EXPECT_TRUE(found.converged) << yaw << ": " << found.reason;
    expect_near(found.T_target_source, T_world_a.inverse() * T_world_b, 0.1, 0.01);
  }
}

TEST(GlobalRegistration, FindsWhatIsFarAwayAndOnAnotherHeight) {
  const auto method = component<Registration>("global_registration", "{min_overlap: 0.2}");
  const SE3 T_world_a = motion(0, 0, 1, 0, 0, 0),
            T_world_b = motion(14, -12, 6, 0, 0, 0) * SE3::from_yaw(2.5);
  const Alignment found = align(*method, forest_scan(T_world_a), forest_scan(T_world_b));
  expect_near(found.T_target_source, T_world_a.inverse() * T_world_b, 0.15, 0.02);
}

TEST(GlobalRegistration, TheGuessChangesNothing) {
  const auto method = component<Registration>("global_registration");
  const Cloud a = forest_scan(SE3{}), b = forest_scan(motion(3, 1, 0, 0, 0, 2));
  EXPECT_TRUE(same_bytes(align(*method, a, b), align(*method, a, b, SE3{})));
}

TEST(GlobalRegistration, SwappedRolesGiveTheInverse) {
  const auto method = component<Registration>("global_registration");
  const Cloud a = forest_scan(SE3{}), b = forest_scan(motion(3, 1, 0, 0, 0, 2));
  expect_near(align(*method, a, b).T_target_source, align(*method, b, a).T_target_source.inverse(),
              0.05, 0.005);
}

TEST(GlobalRegistration, AnotherPlaceDoesNotConverge) {
  const auto method = component<Registration>("global_registration");
  for (const std::uint64_t seed : {2, 3, 4}) {
    const Alignment found = align(*method, forest_scan(SE3{}, 1), forest_scan(SE3{}, seed));
    EXPECT_FALSE(found.converged);
    EXPECT_NE(found.reason, "");
  }
}

TEST(GlobalRegistration, BadCloudsAreNoConvergenceAndSayWhy) {
  const auto method = component<Registration>("global_registration");
  const Cloud good = forest_scan(SE3{}, 1, 8000);
  Cloud three, not_a_number, one_place;
  three.xyz = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  not_a_number.xyz.assign(3000, std::numeric_limits<float>::quiet_NaN());
  one_place.xyz.assign(3000, 1.0F);
  const Cloud far_away = transformed(SE3{Quat::Identity(), Vec3(5e4, 0, 0)}, corridor());
  for (const Cloud& bad : {Cloud{}, three, not_a_number, one_place, far_away})
    for (const Alignment& a : {align(*method, good, bad), align(*method, bad, good)}) {
      EXPECT_FALSE(a.converged);
      EXPECT_NE(a.reason, "");
      EXPECT_TRUE(a.T_target_source.finite());
    }
}

TEST(GlobalRegistration, TheSameBytesFromTwoThreads) {
  const auto method = component<Registration>("global_registration");
  const Cloud a = forest_scan(SE3{}, 1, 8000), b = forest_scan(motion(1, 0, 0, 0, 0, 0.2), 1, 8000);
  std::array<Alignment, 2> results;
  std::thread other([&] { results[0] = align(*method, a, b); });
  results[1] = align(*method, a, b);
  other.join();
  EXPECT_TRUE(same_bytes(results[0], results[1]));
}

TEST(GlobalRegistration, ACorridorIsWeakAlongItself) {
  const auto method = component<Registration>("global_registration");
  const Vec6 sigma = sigmas(align(*method, corridor(), corridor()).information);
  EXPECT_GT(sigma[0], 3 * sigma[1]);
  EXPECT_GT(sigma[0], 3 * sigma[2]);
}

TEST(GlobalRegistration, RefusesAPlanThatWrapsAround) {
  EXPECT_THROW(component<Registration>("global_registration", "{cell_size: 0.5}"), Error);
  EXPECT_NO_THROW(component<Registration>("global_registration",
                                          "{cell_size: 0.5, max_range: 30.0, max_distance: 20.0}"));
}

}  // namespace
}  // namespace cambium::testing
