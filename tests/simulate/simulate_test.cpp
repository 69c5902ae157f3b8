// SPDX-License-Identifier: BSD-3-Clause
#include "simulate/simulate.hpp"

#include <algorithm>
#include <set>
#include <sstream>

#include "cambium/error.hpp"
#include "simulate/folders.hpp"
#include "simulate/spec_file.hpp"

namespace cambium::simulate {
namespace {

using testing::make_context;
using testing::TemporaryFolder;

const std::string text =
    "version: 1\nseed: 3\nstand: {size: [60, 60]}\nsensor: {beams: 8, columns: 128, max_range: "
    "25}\n"
    "trees: {enabled: true}\ngnss: {enabled: true}\npath: {size: [20, 16], spacing: 6}\n"
    "missions:\n  - {name: a}\n  - {name: b, path: {reversed: true}}\n";

std::map<std::string, std::string> simulated(const std::string& spec, int threads) {
  TemporaryFolder folder;
  simulate(parse_spec(spec, "spec.yaml"), spec, folder.path(), *make_context(threads));
  return contents(folder.path());
}

TEST(Simulate, SameSpecificationSameBytesForAnyNumberOfThreads) {
  const auto one = simulated(text, 1);
  EXPECT_GT(one.size(), 2u * 2 * 8);
  for (const int threads : {2, 5}) EXPECT_EQ(simulated(text, threads), one);
}

TEST(Simulate, AnotherSeedGivesAnotherForest) {
  std::string other = text;
  other.replace(other.find("seed: 3"), 7, "seed: 4");
  EXPECT_NE(simulated(other, 2).at("stems.csv"), simulated(text, 2).at("stems.csv"));
}

TEST(Simulate, AMissionDoesNotDependOnTheOthers) {
  const auto both = simulated(text, 2);
  auto alone = simulated(text.substr(0, text.find("  - {name: b")), 2);
  for (const char* file : {"spec.yaml", "stems.csv", "loops.csv"}) alone.erase(file);
  EXPECT_GT(alone.size(), 10u);
  for (const auto& [file, content] : alone) EXPECT_EQ(both.at(file), content) << file;
}

TEST(Simulate, FoldersReadBackWithoutAWarning) {
  const Simulated s("harvested");
  for (const MissionSummary& m : s.summary.missions) {
    const Mission mission = s.mission(m.name);
    EXPECT_TRUE(mission.warnings.empty()) << mission.warnings.front();
    EXPECT_EQ(mission.nodes.size(), m.nodes);
    EXPECT_EQ(mission.edges.size(), m.nodes - 1);
    std::size_t points = 0, trees = 0;
    for (const Node& node : mission.nodes) {
      const Payload p = node.payload->load();
      points += p.cloud->size(), trees += p.trees->size();
    }
    EXPECT_EQ(points, m.points);
    EXPECT_EQ(trees, m.detections);
  }
}

// Points measured on stems lie on the true stems: files, frames and truth belong together.
TEST(Simulate, ReconstructedStemsStandWhereTheMapSaysTheyDo) {
  const Simulated s("harvested");
  const Mission mission = s.mission("mission_b");
  const auto truth = s.truth("mission_b");
  const auto map = s.table("stems.csv");
  std::size_t checked = 0, found = 0;
  for (std::size_t i = 0; i < mission.nodes.size(); ++i) {
    const Payload payload = mission.nodes[i].payload->load();  // keeps the trees alive
    for (const Tree& tree : *payload.trees) {
      if (!tree.reconstructed) continue;
      const Vec3 p = truth[i].T_map_node * tree.base;
      ++checked;
      for (const auto& row : map)
        if (std::hypot(std::stod(row.at("x")) - p.x(), std::stod(row.at("y")) - p.y()) < 0.15 &&
            row.at("mission_b") == "1") {
          ++found;
          break;
        }
    }
  }
  EXPECT_GT(checked, 100u);
  EXPECT_EQ(found, checked);
}

// Trunks lean by some 2 degrees, so nearly all of their points lie within a metre of a foot; others
// seldom do.
TEST(Simulate, LabelsSayWhatTheRaysHit) {
  std::string labelled = text;
  labelled.replace(labelled.find("sensor: {"), 9, "sensor: {labels: true, ");
  TemporaryFolder folder;
  simulate(parse_spec(labelled, "spec.yaml"), labelled, folder.path(), *make_context(2));
  const auto reader = testing::component<MissionReader>("mission_folder");
  const Mission mission = reader->read(folder / "a", *make_context());
  const auto truth = read_tum(folder / "a/ground_truth.tum");
  std::vector<Vec3> feet;
  std::istringstream table(read_file(folder / "stems.csv"));
  std::string line;
  for (std::getline(table, line); std::getline(table, line);)
    feet.push_back({std::stod(line), std::stod(line.substr(line.find(',') + 1)), 0});
  std::map<int, int> all, near;
  for (std::size_t n = 0; n < mission.nodes.size(); ++n) {
    const Payload payload = mission.nodes[n].payload->load();
    const Cloud& cloud = *payload.cloud;
    ASSERT_EQ(cloud.label.size(), cloud.size());
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      const Vec3 p = truth[n].T_map_node * Vec3(cloud.points().col(Eigen::Index(i)).cast<double>());
      ++all[cloud.label[i]];
      near[cloud.label[i]] += std::ranges::any_of(
          feet, [&](const Vec3& foot) { return (foot - p).head<2>().norm() < 1; });
    }
  }
  for (const int label : {2, 64, 66}) EXPECT_GT(all[label], 50) << label;
  EXPECT_EQ(all[0], 0);
  EXPECT_GT(near[64], 0.98 * all[64]);
  EXPECT_LT(near[2], all[2] / 2);
}

TEST(Simulate, LoopsAreNearAndAllOfThem) {
  const Simulated s("harvested");
  std::map<std::string, std::vector<StampedPose>> truth;
  for (const char* m : {"mission_a", "mission_b"}) truth[m] = s.truth(m);
  std::set<std::pair<int, int>> between;
  for (const auto& row : s.table("loops.csv")) {
    const Vec3 a = truth[row.at("tail_mission")][std::stoul(row.at("tail"))].T_map_node.t;
    const Vec3 b = truth[row.at("head_mission")][std::stoul(row.at("head"))].T_map_node.t;
    EXPECT_NEAR((a - b).norm(), std::stod(row.at("baseline")), 1e-3);
    EXPECT_LE(std::stod(row.at("baseline")), s.spec.loops.max_baseline);
    EXPECT_GE(std::stod(row.at("overlap")), s.spec.loops.min_overlap);
    if (row.at("tail_mission") != row.at("head_mission"))
      between.insert({std::stoi(row.at("tail")), std::stoi(row.at("head"))});
  }
  for (std::size_t i = 0; i < truth["mission_a"].size(); ++i)
    for (std::size_t j = 0; j < truth["mission_b"].size(); ++j) {
      const Vec3 a = truth["mission_a"][i].T_map_node.t, b = truth["mission_b"][j].T_map_node.t;
      EXPECT_TRUE((a - b).norm() > 4 || between.contains({int(i), int(j)})) << i << ' ' << j;
    }
}

TEST(Simulate, OutputFolderMayHoldTheSameSimulationAndNothingElse) {
  TemporaryFolder folder;
  const auto spec = parse_spec(text, "spec.yaml");
  const auto context = make_context(2);
  simulate(spec, text, folder.path(), *context);
  const auto before = contents(folder.path());
  simulate(spec, text, folder.path(), *context);
  EXPECT_EQ(contents(folder.path()), before);
  EXPECT_THROW(simulate(spec, text + "# another\n", folder.path(), *context), Error);
  TemporaryFolder other;
  write_file(other / "thesis.tex", "x");
  EXPECT_THROW(simulate(spec, text, other.path(), *context), Error);
}

TEST(Simulate, PathsThatDoNotFitAreRefused) {
  for (const char* path : {"{size: [80, 16]}", "{kind: line, size: [1, 0], spacing: 3}"}) {
    const auto spec =
        parse_spec("version: 1\nstand: {size: [60, 60]}\nmissions:\n  - name: a\n    path: " +
                       std::string(path) + "\n",
                   "spec.yaml");
    TemporaryFolder folder;
    try {
      simulate(spec, "", folder.path(), *make_context());
      ADD_FAILURE() << path;
    } catch (const Error& e) {
      EXPECT_EQ(e.where(), "mission 'a'");
    }
  }
}

}  // namespace
}  // namespace cambium::simulate
