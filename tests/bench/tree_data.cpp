// SPDX-License-Identifier: BSD-3-Clause
#include "bench/tree_data.hpp"

#include <algorithm>
#include <ctime>

#include "cambium/files.hpp"
#include "cambium/path.hpp"

namespace cambium::bench {
namespace {

void describe(TreeMission& m, const PlaceRecognizer& recognizer) {
  const auto context = testing::make_context();
  m.path = travelled(m.mission);
  const Atlas atlas = testing::make_atlas({m.mission});
  m.fingerprints = recognizer.describe({atlas, 0}, *context);
}

}  // namespace

std::vector<TreeMission> tree_missions(const std::string& archive,
                                       const PlaceRecognizer& recognizer) {
  const auto data = testing::real_data(archive);
  if (data.empty()) return {};
  std::vector<std::filesystem::path> folders;
  for (const auto& entry : std::filesystem::directory_iterator(data))
    if (entry.is_directory()) folders.push_back(entry.path());
  std::sort(folders.begin(), folders.end());
  const auto reader = testing::component<MissionReader>("mission_folder");
  std::vector<TreeMission> out;
  for (const auto& folder : folders) {
    TreeMission m;
    m.mission = reader->read(folder, *testing::make_context());
    for (const StampedPose& pose : read_tum(folder / "ground_truth.tum"))
      m.truth.push_back(pose.T_map_node);
    if (m.truth.size() != m.mission.nodes.size())
      throw Error(ErrorCode::data, folder.string(), "nodes and true poses differ in number");
    describe(m, recognizer);
    out.push_back(std::move(m));
  }
  return out;
}

std::vector<TreeMission> pieces(const TreeMission& whole, std::size_t nodes,
                                const PlaceRecognizer& recognizer) {
  std::vector<TreeMission> out;
  const auto& all = whole.mission.nodes;
  for (std::size_t begin = 0; begin + nodes <= all.size(); begin += nodes) {
    const auto first = std::ptrdiff_t(begin), last = std::ptrdiff_t(begin + nodes);
    TreeMission m;
    m.mission.name = whole.mission.name;
    m.mission.nodes.assign(all.begin() + first, all.begin() + last);
    m.truth.assign(whole.truth.begin() + first, whole.truth.begin() + last);
    describe(m, recognizer);
    out.push_back(std::move(m));
  }
  return out;
}

std::vector<TreeMission> far_from(std::vector<TreeMission> missions, double distance) {
  for (TreeMission& m : missions)
    for (SE3& T : m.truth) T.t.x() += distance;
  return missions;
}

void StopWatch::parallel_for(std::size_t count,
                             const std::function<void(std::size_t)>& body) const {
  const auto now = [] { return 1e3 * double(std::clock()) / CLOCKS_PER_SEC; };
  for (std::size_t i = 0; i < count; ++i) {
    const double start = now();
    body(i);
    milliseconds.push_back(now() - start);
  }
}

}  // namespace cambium::bench
