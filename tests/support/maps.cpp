// SPDX-License-Identifier: BSD-3-Clause
#include "support/maps.hpp"

#include "cambium/files.hpp"

namespace cambium::testing {

Atlas tied(Atlas atlas) {
  atlas.islands = {Island{}};
  for (std::uint32_t m = 0; m < atlas.missions.size(); ++m) {
    atlas.islands[0].missions.push_back(m);
    atlas.missions[m].island = 0;
  }
  return atlas;
}

Atlas moved(Atlas atlas, std::uint32_t mission, const SE3& T) {
  auto poses = *atlas.missions[mission].T_map_node;
  for (SE3& pose : poses) pose = T * pose;
  atlas.missions[mission].T_map_node = std::make_shared<const std::vector<SE3>>(std::move(poses));
  return atlas;
}

SE3 far_away() { return SE3::from_yaw(1.3, {100, -200, 5}); }

void write_truth(const Atlas& atlas, const std::filesystem::path& folder,
                 const SE3& T_world_mission) {
  for (const MissionState& state : atlas.missions) {
    std::vector<StampedPose> rows;
    for (const Node& node : state.mission->nodes)
      rows.push_back({*node.stamp, T_world_mission * node.T_mission_node});
    write_file(folder / (state.mission->name + ".tum"), format_tum(rows));
  }
}

std::map<std::string, double> evaluate(const std::string& plugin, const Atlas& atlas,
                                       const std::filesystem::path& reference,
                                       const std::string& yaml, int threads) {
  const auto evaluator = component<Evaluator>(plugin, yaml);
  std::map<std::string, double> out;
  for (const Metric& m : evaluator->evaluate(atlas, reference, *make_context(threads))) {
    EXPECT_TRUE(out.emplace(m.name, m.value).second) << m.name << " twice";
    EXPECT_TRUE(m.name.starts_with(plugin + ".")) << m.name;
  }
  return out;
}

}  // namespace cambium::testing
