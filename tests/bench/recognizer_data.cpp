// SPDX-License-Identifier: BSD-3-Clause
#include "recognizer_data.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cambium/files.hpp"

namespace cambium::bench {
namespace {

class Turned final : public PayloadSource {
 public:
  Turned(std::shared_ptr<const PayloadSource> source, const SE3& T_turned_base)
      : source_(std::move(source)), T_turned_base_(T_turned_base) {}
  Payload load() const override {
    Payload payload = source_->load();
    if (payload.cloud)
      payload.cloud = std::make_shared<const Cloud>(transformed(T_turned_base_, *payload.cloud));
    return payload;
  }
  Digest digest() const override { return {}; }
  std::string where() const override { return source_->where(); }

 private:
  std::shared_ptr<const PayloadSource> source_;
  SE3 T_turned_base_;
};

std::vector<SE3> true_poses(const Mission& mission) {
  std::vector<SE3> out;
  const auto file = mission.folder / "ground_truth.tum";
  if (!std::filesystem::exists(file)) {
    for (const Node& node : mission.nodes) out.push_back(node.T_mission_node);
    return out;
  }
  for (const auto& pose : read_tum(file)) out.push_back(pose.T_map_node);
  if (out.size() != mission.nodes.size())
    throw Error(ErrorCode::data, file.string(),
                "expected one pose for each of " + std::to_string(mission.nodes.size()) +
                    " nodes, found " + std::to_string(out.size()));
  return out;
}

void turn(Node& node, SE3& T_world_node, double yaw) {
  const SE3 T_turned_base = SE3::from_yaw(yaw);
  node.payload = std::make_shared<Turned>(node.payload, T_turned_base);
  node.T_mission_node = node.T_mission_node * T_turned_base.inverse();
  T_world_node = T_world_node * T_turned_base.inverse();
}

// An atlas is ordered by name: the reference comes first.
Scene scene_of(const std::string& name, Mission query, std::vector<SE3> true_query,
               Mission reference, std::vector<SE3> true_reference) {
  reference.name = "a";
  query.name = "b";
  return {name, cambium::testing::make_atlas({std::move(reference), std::move(query)}),
          std::move(true_query), std::move(true_reference)};
}

Scene split(const std::string& name, const Mission& mission, std::size_t every) {
  const std::vector<SE3> poses = true_poses(mission);
  Mission query = mission, reference = mission;
  std::vector<SE3> of_query, of_reference;
  query.nodes.clear(), reference.nodes.clear(), query.edges.clear(), reference.edges.clear();
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const bool is_reference = i % every == 0;
    (is_reference ? reference : query).nodes.push_back(mission.nodes[i]);
    (is_reference ? of_reference : of_query).push_back(poses[i]);
  }
  for (std::size_t i = 0; i < of_query.size(); ++i)
    turn(query.nodes[i], of_query[i], double(i) * 77.0 * std::numbers::pi / 180.0);
  return scene_of(name, query, of_query, reference, of_reference);
}

}  // namespace

double Scene::nearest(std::size_t q) const {
  double out = std::numeric_limits<double>::infinity();
  for (std::size_t r = 0; r < reference.size(); ++r) out = std::min(out, distance(q, r));
  return out;
}

bool Scene::is_right(const Candidate& c) const {
  return distance(c.query, c.reference) <= std::hypot(nearest(c.query), 6.0);
}

Scene load_scene(const std::string& what, const Context& context) {
  const auto comma = what.find(',');
  if (comma == std::string::npos)
    throw Error(ErrorCode::config, what, "expected QUERY,REFERENCE or MISSION,K");
  const std::string first = what.substr(0, comma), second = what.substr(comma + 1);
  const auto name = [](const std::string& folder) {
    return std::filesystem::path(folder).filename().string();
  };
  const auto reader = cambium::testing::component<MissionReader>("mission_folder");
  const Mission query = reader->read(first, context);
  if (second.find_first_not_of("0123456789") == std::string::npos)
    return split(name(first) + ", every " + second, query, std::stoul(second));
  const Mission reference = reader->read(second, context);
  return scene_of(name(first), query, true_poses(query), reference, true_poses(reference));
}

std::pair<std::string, std::string> name_and_params(const std::string& what) {
  const auto brace = std::min(what.find('{'), what.size());
  return {what.substr(0, brace), brace == what.size() ? "{}" : what.substr(brace)};
}

Scene filtered(const Scene& scene, const std::string& filter, const Context& context) {
  const auto [name, yaml] = name_and_params(filter);
  const auto component = cambium::testing::component<PayloadFilter>(name, yaml);
  std::vector<Mission> missions;
  for (std::uint32_t m = 0; m < 2; ++m) {
    const MissionView view{scene.atlas, m};
    missions.push_back(view.mission());
    for (std::size_t i = 0; i < view.size(); ++i)
      missions.back().nodes[i].payload =
          cambium::testing::in_memory(component->apply(view, i, context));
  }
  Scene out = scene;
  out.atlas = cambium::testing::make_atlas(std::move(missions));
  return out;
}

}  // namespace cambium::bench
