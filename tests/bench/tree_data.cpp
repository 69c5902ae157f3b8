// SPDX-License-Identifier: BSD-3-Clause
#include "bench/tree_data.hpp"

#include <algorithm>
#include <ctime>

#include "cambium/files.hpp"
#include "cambium/path.hpp"
#include "simulate/simulate.hpp"
#include "simulate/spec_file.hpp"

namespace cambium::bench {
namespace {

void describe(TreeMission& m, const PlaceRecognizer& recognizer) {
  const auto context = testing::make_context();
  m.path = travelled(m.mission);
  const Atlas atlas = testing::make_atlas({m.mission});
  m.fingerprints = recognizer.describe({atlas, 0}, *context);
}

std::vector<TreeMission> read_missions(const std::filesystem::path& data,
                                       const PlaceRecognizer& recognizer) {
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

const std::string stand = R"(version: 1
stand: {size: [260, 120]}
sensor: {clouds: false}
trees: {enabled: true}
odometry: {drift: 1}
path: {kind: line, size: [200, 0], spacing: 2}
missions:
  - {name: mission_a}
  - {name: mission_b, path: {offset: 7, reversed: true}}
  - {name: mission_c, path: {offset: 12}}
  - {name: mission_d, path: {offset: 17, reversed: true}}
  - {name: mission_e, path: {offset: 22}}
)";

}  // namespace

std::vector<TreeMission> tree_missions(const std::string& archive,
                                       const PlaceRecognizer& recognizer) {
  const auto data = testing::real_data(archive);
  return data.empty() ? std::vector<TreeMission>{} : read_missions(data, recognizer);
}

std::vector<TreeMission> simulated_missions(int seed, const PlaceRecognizer& recognizer) {
  const auto folder = std::make_shared<testing::TemporaryFolder>();
  const std::string text = stand + "seed: " + std::to_string(seed) + "\n";
  const auto spec = simulate::parse_spec(text, "stand");
  simulate::simulate(spec, text, folder->path(), *testing::make_context());
  auto out = read_missions(folder->path(), recognizer);
  for (TreeMission& m : out) m.files = folder;
  return out;
}

std::vector<TreeMission> pieces(const TreeMission& whole, std::size_t nodes,
                                const PlaceRecognizer& recognizer) {
  std::vector<TreeMission> out;
  const auto& all = whole.mission.nodes;
  for (std::size_t begin = 0; begin + nodes <= all.size(); begin += nodes) {
    const auto first = std::ptrdiff_t(begin), last = std::ptrdiff_t(begin + nodes);
    TreeMission m;
    m.files = whole.files;
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
