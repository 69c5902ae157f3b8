// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "cambium/files.hpp"
#include "support/maps.hpp"

namespace cambium::testing {
namespace {

constexpr double degree = M_PI / 180;

/// Missions a and b: 40 nodes, 2 m apart, on a straight line each.
class Rpe : public ::testing::Test {
 protected:
  Rpe() {
    std::vector<SE3> poses;
    for (int i = 0; i < 40; ++i) poses.push_back(SE3::from_yaw(0, {2.0 * i, 0, 0}));
    atlas_ = tied(make_atlas({make_mission("a", poses), make_mission("b", poses)}));
    write_truth(atlas_, folder_.path(), SE3{});  // exact: some pairs just miss a length
  }

  /// b with every pose replaced by change(pose, index).
  template <class Change>
  Atlas bent(Change change) const {
    Atlas out = atlas_;
    auto poses = *out.missions[1].T_map_node;
    for (std::size_t i = 0; i < poses.size(); ++i) poses[i] = change(poses[i], i);
    out.missions[1].T_map_node = std::make_shared<const std::vector<SE3>>(poses);
    return out;
  }

  std::map<std::string, double> rpe(const Atlas& atlas, const std::string& yaml = "{}") const {
    return evaluate("rpe", atlas, folder_.path(), yaml);
  }

  TemporaryFolder folder_;
  Atlas atlas_;
};

TEST_F(Rpe, IsZeroForTruePathsWhereverTheyLie) {
  const auto m = rpe(moved(atlas_, 1, SE3::from_yaw(0.7, {30, 4, 1})));
  EXPECT_LT(m.at("rpe.translation"), 1e-9);
  EXPECT_LT(m.at("rpe.rotation"), 1e-9);
  EXPECT_EQ(m.at("rpe.pairs"), 2 * (36 + 32 + 20));
}

// A path that is 1 % too long is 1 % wrong over every distance.
TEST_F(Rpe, MeasuresAWrongScale) {
  const auto m = rpe(bent([](SE3 T, std::size_t) {
    T.t *= 1.01;
    return T;
  }));
  EXPECT_NEAR(m.at("rpe.b.translation"), 1, 1e-9);
  EXPECT_LT(m.at("rpe.b.rotation"), 1e-9);
  EXPECT_LT(m.at("rpe.a.translation"), 1e-9);
  EXPECT_NEAR(m.at("rpe.translation"), std::sqrt(0.5), 1e-9);  // half of the pairs
  for (const char* name : {"rpe.10m.translation", "rpe.20m.translation", "rpe.50m.translation"})
    EXPECT_NEAR(m.at(name), std::sqrt(0.5), 1e-9) << name;
}

// A path that turns by 0.1 degrees a metre while the robot goes straight on.
TEST_F(Rpe, MeasuresAWrongTurn) {
  const auto m = rpe(bent([](SE3 T, std::size_t i) {
    T.q = SE3::from_yaw(0.2 * degree * double(i)).q;
    return T;
  }));
  EXPECT_NEAR(m.at("rpe.b.rotation"), 0.1, 1e-9);
  // Seen from the turned node, the way ahead of length d ends |2 d sin(yaw / 2)| off: an angle of
  // the node itself, so it grows along the path. RMS over the 36 pairs at 10 m.
  double squares = 0;
  for (int i = 0; i < 36; ++i) squares += std::pow(2 * std::sin(0.1 * degree * i), 2);
  const auto only = rpe(bent([](SE3 T, std::size_t i) {
                          T.q = SE3::from_yaw(0.2 * degree * double(i)).q;
                          return T;
                        }),
                        "{deltas: [10]}");
  EXPECT_NEAR(only.at("rpe.b.translation"), 100 * std::sqrt(squares / 36), 1e-9);
}

TEST_F(Rpe, PairsAreThoseNearestToTheLength) {
  // 7 m lies between the nodes at 6 m and 8 m; the nearer is 1 m off, which is a seventh.
  EXPECT_EQ(rpe(atlas_, "{deltas: [7], tolerance: 0.15}").at("rpe.pairs"), 2 * 37);
  EXPECT_EQ(rpe(atlas_, "{deltas: [7], tolerance: 0.14}").at("rpe.pairs"), 0);
  EXPECT_EQ(rpe(atlas_, "{deltas: [500]}").count("rpe.translation"), 0u);
}

TEST_F(Rpe, ARobotThatStandsStillIsJudgedOverTheWayItWent) {
  std::vector<SE3> poses(5, SE3{});
  for (int i = 0; i < 4; ++i) poses.push_back(SE3::from_yaw(0, {5.0 * (i + 1), 0, 0}));
  atlas_ = make_atlas({make_mission("a", poses)});
  write_truth(atlas_, folder_.path(), SE3{});  // exact: some pairs just miss a length
  EXPECT_EQ(rpe(atlas_, "{deltas: [10]}").at("rpe.pairs"), 5 + 2);
}

TEST_F(Rpe, NeedsTruthAndLengths) {
  std::filesystem::remove(folder_ / "a.tum");
  EXPECT_EQ(rpe(atlas_).count("rpe.a.translation"), 0u);
  std::filesystem::remove(folder_ / "b.tum");
  EXPECT_THROW(rpe(atlas_), Error);
  EXPECT_THROW(component<Evaluator>("rpe", "{deltas: []}"), Error);
}

}  // namespace
}  // namespace cambium::testing
