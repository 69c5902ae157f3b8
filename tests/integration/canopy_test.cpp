// SPDX-License-Identifier: BSD-3-Clause
// A robot on the ground and a drone above the canopy become one map.
#include <cmath>

#include "cambium/files.hpp"
#include "cambium/fit.hpp"
#include "command.hpp"
#include "support/places.hpp"
#include "support/support.hpp"

using namespace cambium;
using namespace cambium::testing;

namespace {

std::vector<Vec3> places(const std::filesystem::path& tum) {
  std::vector<Vec3> out;
  for (const StampedPose& pose : read_tum(tum)) out.push_back(pose.T_map_node.t);
  return out;
}

}  // namespace

TEST(FuseCanopy, StemsFromTheGroundAndTopsFromAboveMakeOneMap) {
  const TemporaryFolder folder;
  const auto simulated = run_cambium(
      {"simulate", source("tests/specs/canopy.yaml").string(), (folder / "missions").string()});
  ASSERT_EQ(simulated.code, 0) << simulated.err;
  const auto run =
      run_cambium({"run", pipeline("fuse_canopy.yaml"), (folder / "missions/ground").string(),
                   (folder / "missions/flight").string(), "--out", (folder / "map").string()});
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(read_json(folder / "map/report.json")["islands"].size(), 1u) << run.err;
  // Each mission laid on the truth for itself: how far do the two disagree about the ground?
  const auto T_world_map = [&](const std::string& mission) {
    return fit_yaw(places(folder / ("missions/" + mission + "/ground_truth.tum")),
                   places(folder / ("map/" + mission + ".tum")));
  };
  const SE3 by_ground = T_world_map("ground"), by_flight = T_world_map("flight");
  double squares = 0;
  const auto ground = places(folder / "map/ground.tum");
  for (const Vec3& p : ground) squares += (by_ground * p - by_flight * p).squaredNorm();
  EXPECT_LT(std::sqrt(squares / double(ground.size())), 0.3);
}
