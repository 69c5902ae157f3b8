// SPDX-License-Identifier: BSD-3-Clause
#include "engine/split.hpp"

#include "cambium/pose_graph.hpp"
#include "support/maps.hpp"
#include "support/pose_graph.hpp"

using namespace cambium;
using namespace cambium::testing;

namespace {

std::vector<SE3> helix(int n) {
  std::vector<SE3> poses;
  Vec6 xi;
  for (int i = 0; i < n; ++i) {
    xi << 2.0 * i, 0, 0.1 * i, 0.02 * i, 0.01 * i, 0.1 * i;
    poses.push_back(SE3::exp(xi));
  }
  return poses;
}

StampedPose at(double seconds, const SE3& T) {
  return {{std::int64_t(seconds), std::int32_t((seconds - std::int64_t(seconds)) * 1e9 + 0.5)}, T};
}

}  // namespace

TEST(Split, EdgesAndPriorsMeanTheSameInTheNewFrame) {
  Mission mission = make_mission("a", helix(10));
  Edge prior = mission.edges[0];
  prior.kind = EdgeKind::prior;
  prior.tail = prior.head = 3;
  prior.T_tail_head = mission.nodes[3].T_mission_node * SE3::from_yaw(0.1, {0.5, 0.2, 0.1});
  for (int i = 0; i < 6; ++i) prior.information(i, i) = 1 + i;
  prior.information(0, 4) = prior.information(4, 0) = 0.5;
  Edge position = prior;
  position.kind = EdgeKind::position;
  position.tail = position.head = 5;
  mission.edges.push_back(prior);
  mission.edges.push_back(position);
  Atlas atlas = moved(make_atlas({mission}), 0, helix(7).back());
  const Mission out = updated_mission(atlas, 0);
  EXPECT_EQ(out.nodes[4].id, 4);
  EXPECT_EQ(out.nodes[4].T_mission_node.t, atlas.T_map_node({0, 4}).t);
  EXPECT_EQ(out.edges[0].T_tail_head.t, mission.edges[0].T_tail_head.t);
  const PoseGraph own = pose_graph_from(mission), map = pose_graph_from(out);
  EXPECT_GT(cost(own, own.T_map_node), 0.1);
  EXPECT_NEAR(cost(map, map.T_map_node), cost(own, own.T_map_node), 1e-9);
}

TEST(Split, CarriesTheGeoreferenceOfTheIsland) {
  Atlas atlas = make_atlas({make_mission("a", helix(5))});
  atlas.islands[0].georeference = GeoReference{61, 25, 100, SE3::from_yaw(1, {1, 2, 3}), 0, 0};
  const Mission out = updated_mission(atlas, 0);
  ASSERT_TRUE(out.georeference);
  EXPECT_EQ(out.georeference->T_map_enu.t, Vec3(1, 2, 3));
}

TEST(PosesAt, FollowTheGeodesicBetweenNodes) {
  const Atlas atlas = make_atlas({make_mission("a", helix(4))});  // one node a second
  const Interpolator path(atlas.missions[0], {});
  EXPECT_EQ(path.T_map_base({2, 0})->t, atlas.T_map_node({0, 2}).t);
  const SE3 half = interpolate(atlas.T_map_node({0, 1}), atlas.T_map_node({0, 2}), 0.5);
  EXPECT_LT((path.T_map_base({1, 500'000'000})->t - half.t).norm(), 1e-12);
  EXPECT_TRUE(path.T_map_base({0, 0}) && path.T_map_base({3, 0}));
  EXPECT_FALSE(path.T_map_base({3, 1}));
}

// Odometry drifts, in a frame of its own; between nodes only its shape counts.
TEST(PosesAt, FollowOdometryWhereItExists) {
  const auto truth = [](double t) {
    return SE3::from_yaw(0.8 * t, {4 * std::sin(t), 3 * std::cos(2 * t), 0.1 * t});
  };
  const Atlas atlas = make_atlas({make_mission("a", {truth(0), truth(1), truth(2), truth(3)})});
  const SE3 T_odom_map = SE3::from_yaw(2, {70, -3, 1});
  std::vector<StampedPose> odometry;
  for (int i = 0; i <= 40; ++i)
    odometry.push_back(at(i / 20.0, T_odom_map * truth(i / 20.0) * SE3::from_yaw(1e-3 * i)));
  const Interpolator path(atlas.missions[0], odometry), without(atlas.missions[0], {});
  for (double t = 0; t <= 2; t += 0.05) {
    const Stamp stamp = at(t, {}).stamp;
    EXPECT_LT((path.T_map_base(stamp)->t - truth(t).t).norm(), 0.03) << t;
  }
  EXPECT_GT((without.T_map_base({0, 500'000'000})->t - truth(0.5).t).norm(), 0.3);
  // At nodes nothing of the drift is left, and behind the odometry the geodesic takes over.
  EXPECT_LT((path.T_map_base({1, 0})->t - truth(1).t).norm(), 1e-12);
  EXPECT_EQ(path.T_map_base({2, 500'000'000})->t, without.T_map_base({2, 500'000'000})->t);
}

TEST(PosesAt, StampsInEveryForm) {
  const auto stamps = parse_stamps(
      "#timestamp [ns],filename\n1403636579763555584,1403636579763555584.png\nsec,nsec\n"
      "12,5\n12.000000007\n12\n",
      "times.csv");
  ASSERT_EQ(stamps.size(), 4u);
  EXPECT_EQ(stamps[0], (Stamp{1403636579, 763555584}));
  EXPECT_EQ(stamps[1], (Stamp{12, 5}));
  EXPECT_EQ(stamps[2], (Stamp{12, 7}));
  EXPECT_EQ(stamps[3], (Stamp{12, 0}));
  EXPECT_THROW(parse_stamps("-3\n", "times.csv"), Error);
}
