// SPDX-License-Identifier: BSD-3-Clause
#include "cambium/truth.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "cambium/error.hpp"
#include "cambium/files.hpp"
#include "cambium/path.hpp"

namespace cambium {
namespace {

std::optional<SE3> nearest(const std::vector<StampedPose>& poses, const Stamp& stamp,
                           double max_time_difference) {
  const auto after = std::lower_bound(
      poses.begin(), poses.end(), stamp,
      [](const StampedPose& pose, const Stamp& value) { return pose.stamp < value; });
  std::optional<SE3> best;
  double best_difference = max_time_difference;
  const auto consider = [&](auto pose) {
    const double difference = std::abs(seconds_between(pose->stamp, stamp));
    if (difference > best_difference) return;
    best = pose->T_map_node;
    best_difference = difference;
  };
  if (after != poses.end()) consider(after);
  if (after != poses.begin()) consider(std::prev(after));
  return best;
}

}  // namespace

std::filesystem::path truth_file(const Mission& mission, const std::filesystem::path& reference) {
  if (reference.empty()) return mission.folder / "ground_truth.tum";
  const auto in_folder = reference / mission.name / "ground_truth.tum";
  if (std::filesystem::exists(in_folder)) return in_folder;
  return reference / (mission.name + ".tum");
}

void Truth::require_matches() const {
  if (matched > 0) return;
  throw Error(
      ErrorCode::data, files.empty() ? "" : files.front(),
      fmt::format("no node of {} missions has a true pose; expected rows `stamp x y z qx qy "
                  "qz qw` at the times of the nodes: name the folder with the truth, or "
                  "raise max_time_difference",
                  T_world_node.size()));
}

Truth read_truth(const Atlas& atlas, const std::filesystem::path& reference,
                 double max_time_difference) {
  Truth truth;
  for (const MissionState& state : atlas.missions) {
    const Mission& mission = *state.mission;
    const auto file = truth_file(mission, reference);
    truth.files.push_back(file.string());
    auto& T_world_node = truth.T_world_node.emplace_back(mission.nodes.size());
    if (!std::filesystem::exists(file)) continue;
    std::vector<StampedPose> poses = read_tum(file);
    std::stable_sort(poses.begin(), poses.end(),
                     [](const StampedPose& a, const StampedPose& b) { return a.stamp < b.stamp; });
    // Of nodes that share a stamp it is not known which one was where: none has a true pose.
    std::map<Stamp, int> carriers;
    for (const Node& node : mission.nodes)
      if (node.stamp) ++carriers[*node.stamp];
    for (std::size_t i = 0; i < mission.nodes.size(); ++i) {
      if (!mission.nodes[i].stamp || carriers[*mission.nodes[i].stamp] > 1) continue;
      T_world_node[i] = nearest(poses, *mission.nodes[i].stamp, max_time_difference);
      truth.matched += T_world_node[i].has_value();
    }
  }
  return truth;
}

}  // namespace cambium
