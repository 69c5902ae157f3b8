// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <limits>

#include "cambium/geodesy.hpp"
#include "support/maps.hpp"

namespace cambium::testing {
namespace {

constexpr Geodetic reference{61.2, 25.1, 150};

/// Missions a and b, a node each second; exact fixes half a second behind each node but the last.
class GnssResiduals : public ::testing::Test {
 protected:
  GnssResiduals() {
    std::vector<Mission> missions;
    for (const char* name : {"a", "b"}) {
      std::vector<SE3> poses;
      for (int i = 0; i < 20; ++i)
        poses.push_back(SE3::from_yaw(0.1 * i, {3.0 * i, *name == 'a' ? 0.0 : 20.0, 0.1 * i}));
      missions.push_back(make_mission(name, poses));
      for (int i = 0; i + 1 < 20; ++i) {
        const Vec3 p_map = (poses[std::size_t(i)].t + poses[std::size_t(i) + 1].t) / 2;
        missions.back().fixes.push_back(fix_at({i, 500000000}, p_map));
      }
    }
    atlas_ = tied(make_atlas(missions));
    atlas_.islands[0].georeference =
        GeoReference{reference.latitude, reference.longitude, reference.altitude, T_map_enu()};
  }

  static SE3 T_map_enu() { return SE3::from_yaw(0.8, {10, 20, 30}); }

  static GnssFix fix_at(const Stamp& stamp, const Vec3& p_map) {
    const Geodetic g = from_enu(reference, T_map_enu().inverse() * p_map);
    return {stamp, g.latitude, g.longitude, g.altitude, Mat3(Mat3::Identity() * 4.0)};
  }

  void add_fix(const GnssFix& fix) {
    Mission a = *atlas_.missions[0].mission;
    a.fixes.push_back(fix);
    atlas_.missions[0].mission = std::make_shared<const Mission>(a);
  }

  static std::map<std::string, double> residuals(const Atlas& atlas,
                                                 const std::string& yaml = "{}") {
    return evaluate("gnss_residuals", atlas, {}, yaml);
  }

  Atlas atlas_;
};

TEST_F(GnssResiduals, AreZeroForExactFixes) {
  const auto m = residuals(atlas_);
  EXPECT_LT(m.at("gnss_residuals.horizontal"), 1e-6);
  EXPECT_LT(m.at("gnss_residuals.vertical"), 1e-6);
  EXPECT_EQ(m.at("gnss_residuals.fixes"), 38);
  EXPECT_EQ(m.at("gnss_residuals.unused_fixes"), 0);
}

TEST_F(GnssResiduals, MeasureAKnownShift) {
  const auto m = residuals(moved(atlas_, 1, SE3::from_yaw(0, {0.3, 0.4, 0.7})));
  EXPECT_NEAR(m.at("gnss_residuals.b.horizontal"), 0.5, 1e-6);
  EXPECT_NEAR(m.at("gnss_residuals.b.vertical"), 0.7, 1e-6);
  EXPECT_NEAR(m.at("gnss_residuals.b.horizontal_median"), 0.5, 1e-6);
  EXPECT_LT(m.at("gnss_residuals.a.horizontal"), 1e-6);
  EXPECT_NEAR(m.at("gnss_residuals.horizontal"), 0.5 * std::sqrt(0.5), 1e-6);  // half of the fixes
  // 0.5 m where the receiver states 2 m east and north.
  EXPECT_NEAR(m.at("gnss_residuals.b.normalised"), 0.25 / std::sqrt(2), 1e-6);
}

TEST_F(GnssResiduals, FixesBesideThePathAreCountedNotJudged) {
  add_fix(fix_at({1000, 0}, Vec3(500, 0, 0)));
  add_fix(fix_at({-5, 0}, Vec3(500, 0, 0)));
  GnssFix broken = fix_at({3, 0}, Vec3::Zero());
  broken.latitude = std::numeric_limits<double>::quiet_NaN();
  add_fix(broken);
  const auto m = residuals(atlas_);
  EXPECT_EQ(m.at("gnss_residuals.unused_fixes"), 3);
  EXPECT_LT(m.at("gnss_residuals.horizontal"), 1e-6);
  EXPECT_EQ(residuals(atlas_, "{max_gap: 0.9}").at("gnss_residuals.fixes"), 0);
}

TEST_F(GnssResiduals, AFixAtTheTimeOfANodeNeedsNoNeighbour) {
  add_fix(fix_at({19, 0}, atlas_.missions[0].mission->nodes[19].T_mission_node.t));
  const auto m = residuals(atlas_);
  EXPECT_EQ(m.at("gnss_residuals.fixes"), 39);
  EXPECT_LT(m.at("gnss_residuals.horizontal"), 1e-6);
}

TEST_F(GnssResiduals, AMapWithoutGeoreferenceHasNone) {
  atlas_.islands[0].georeference.reset();
  EXPECT_EQ(residuals(atlas_).at("gnss_residuals.fixes"), 0);
  EXPECT_EQ(residuals(atlas_).count("gnss_residuals.horizontal"), 0u);
}

}  // namespace
}  // namespace cambium::testing
