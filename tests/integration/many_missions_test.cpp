// SPDX-License-Identifier: BSD-3-Clause
// Four missions through real plugins: in any order, one after another, named twice.
#include <algorithm>
#include <cmath>

#include "cambium/dialect.hpp"
#include "cambium/files.hpp"
#include "command.hpp"
#include "support/places.hpp"
#include "support/support.hpp"

using namespace cambium;
using namespace cambium::testing;
namespace fs = std::filesystem;

namespace {

// A second wave that starts from the relaxed map, as the shipped pipelines have it.
constexpr const char* two_waves =
    "version: 1\nsteps:\n"
    "  - recognize: tree_match\n    pairs: all\n    min_path: 50\n"
    "  - register: tree_align\n  - verify: pairwise_consistency\n"
    "  - optimize: sparse_lm\n    attitude_sigma: 0.1\n    params: {loss: cauchy}\n"
    "  - recognize: proximity\n    pairs: between_missions\n    params: {radius: 8.0, candidates: "
    "2}\n"
    "  - register: tree_align\n  - verify: pairwise_consistency\n"
    "  - optimize: sparse_lm\n    attitude_sigma: 0.1\n    params: {loss: cauchy}\n"
    "  - evaluate: ate\n  - evaluate: loops\n";

constexpr const char* three_scanners =
    "version: 1\nseed: 3\nstand: {size: [60, 50], density: 700}\n"
    "sensor: {beams: 16, columns: 360, max_range: 30}\n"
    "path: {kind: loop, size: [26, 14], spacing: 3}\n"
    "missions:\n  - {name: mission_a}\n  - {name: mission_b, path: {offset: 1, reversed: true}}\n"
    "  - {name: mission_c, path: {center: [3, 2], heading: 20}}\n";
constexpr const char* two_waves_of_scans =
    "version: 1\nsteps:\n"
    "  - recognize: scan_context\n    pairs: between_missions\n"
    "    params: {max_range: 30.0, candidates: 1, threshold: 0.55}\n"
    "  - register: gicp\n    params: {min_overlap: 0.4}\n"
    "  - verify: pairwise_consistency\n  - optimize: sparse_lm\n"
    "  - recognize: proximity\n    pairs: between_missions\n    params: {radius: 6.0, candidates: "
    "2}\n"
    "  - register: gicp\n    params: {min_overlap: 0.4, search_radius: 2.0, hypotheses: 1}\n"
    "  - verify: pairwise_consistency\n  - optimize: sparse_lm\n    params: {loss: cauchy}\n";

class ManyMissions : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TemporaryFolder;
    const auto simulated = run_cambium(
        {"simulate", source("tests/specs/fleet.yaml").string(), (*folder_ / "missions").string()});
    ASSERT_EQ(simulated.code, 0) << simulated.err;
    write_file(*folder_ / "p.yaml", two_waves);
  }
  static void TearDownTestSuite() {
    delete folder_;
    folder_ = nullptr;
  }

  static fs::path path(const std::string& name) { return *folder_ / name; }
  static std::string mission(char letter) {
    return path(std::string("missions/mission_") + letter).string();
  }
  static Outcome fuse(const std::vector<std::string>& missions, const std::string& out,
                      const std::string& cache = "none", const std::string& pipeline = "p.yaml") {
    std::vector<std::string> arguments{"run", path(pipeline).string(), "--out", path(out).string()};
    arguments.insert(arguments.end(), missions.begin(), missions.end());
    arguments.insert(arguments.end(),
                     {"--cache", cache == "none" ? cache : path(cache).string(), "--quiet"});
    return run_cambium(arguments);
  }
  static std::string text(const std::string& file) { return read_file(path(file)); }

  /// The same loops, the same map, and F to 1e-6.
  static void expect_the_same(const std::string& one, const std::string& other) {
    EXPECT_EQ(text(one + "/ledger.jsonl"), text(other + "/ledger.jsonl"));
    EXPECT_EQ(text(one + "/fused.g2o"), text(other + "/fused.g2o"));
    const auto cost = [](const nlohmann::json& report) {
      double last = NAN;
      for (const auto& step : report["steps"])
        if (step["verb"] == "optimize") last = step["figures"]["cost.after"];
      return last;
    };
    const double all = cost(read_json(path(other + "/report.json")));
    EXPECT_NEAR(cost(read_json(path(one + "/report.json"))), all, 1e-6 * all);
  }

 private:
  static TemporaryFolder* folder_;
};

TemporaryFolder* ManyMissions::folder_ = nullptr;

/// The work items of a step: how many there were, and how many of them the cache did not have.
struct Items {
  std::size_t all, computed;
};

/// Of the steps with this verb, wave by wave.
std::vector<Items> items(const nlohmann::json& report, const std::string& verb) {
  std::vector<Items> out;
  for (const auto& step : report["steps"])
    if (step["verb"] == verb) {
      const std::size_t all = step["items"], cached = step["cached_items"];
      out.push_back({all, all - cached});
    }
  return out;
}

/// What the step of a grown map computed, when it computes what the new mission brings and nothing
/// else.
void expect_only_what_is_new(const nlohmann::json& before, const nlohmann::json& grown) {
  for (const std::string verb : {"recognize", "register"}) {
    const auto known = items(before, verb), now = items(grown, verb);
    ASSERT_EQ(now.size(), known.size());
    for (std::size_t wave = 0; wave < now.size(); ++wave) {
      EXPECT_EQ(now[wave].computed, now[wave].all - known[wave].all) << verb << ", wave " << wave;
      EXPECT_GT(now[wave].computed, 0u) << verb << ", wave " << wave;
      EXPECT_GT(known[wave].computed, 0u) << verb << ", wave " << wave;
    }
  }
}

}  // namespace

TEST_F(ManyMissions, TheFusedGraphIsTheSameInEveryOrder) {
  std::vector<char> order{'a', 'b', 'c', 'd'};
  const auto named = [&] {
    std::vector<std::string> out;
    for (const char m : order) out.push_back(mission(m));
    return out;
  };
  const Outcome first = fuse(named(), "first");
  ASSERT_EQ(first.code, 0) << first.err;
  const auto report = read_json(path("first/report.json"));
  ASSERT_EQ(report["islands"].size(), 1u);
  EXPECT_EQ(metric(report, "loops.wrong"), 0);
  EXPECT_LT(metric(report, "ate.rmse"), 0.15);
  std::size_t permutations = 1;
  while (std::next_permutation(order.begin(), order.end())) {
    // The last one computes everything again; the others share what does not depend on order.
    const bool last = order == std::vector<char>{'d', 'c', 'b', 'a'};
    ASSERT_EQ(fuse(named(), "other", last ? "none" : "cache").code, 0);
    for (const char* file : {"fused.g2o", "ledger.jsonl", "mission_c.tum"})
      EXPECT_EQ(text(std::string("first/") + file), text(std::string("other/") + file)) << file;
    ++permutations;
  }
  EXPECT_EQ(permutations, 24u);
}

TEST_F(ManyMissions, AGrownMapIsTheMapOfAllAndOnlyNewPairsAreComputed) {
  ASSERT_EQ(fuse({mission('a'), mission('b')}, "ab", "growing").code, 0);
  const Outcome grown = fuse({path("ab").string(), mission('c')}, "grown", "growing");
  ASSERT_EQ(grown.code, 0) << grown.err;
  ASSERT_EQ(fuse({mission('a'), mission('b'), mission('c')}, "abc").code, 0);
  expect_the_same("grown", "abc");
  expect_only_what_is_new(read_json(path("ab/report.json")), read_json(path("grown/report.json")));
}

// C also moves the map of A and B: they are looked at by their own loops alone.
TEST_F(ManyMissions, AMissionNamedEarlierMakesNothingOldNew) {
  ASSERT_EQ(fuse({mission('b'), mission('d')}, "bd", "earlier").code, 0);
  ASSERT_EQ(fuse({path("bd").string(), mission('a')}, "abd", "earlier").code, 0);
  expect_only_what_is_new(read_json(path("bd/report.json")), read_json(path("abd/report.json")));
}

TEST_F(ManyMissions, AMapOfScansGrowsAndOnlyNewPairsAreComputed) {
  write_file(path("scans.yaml"), three_scanners);
  write_file(path("p_scans.yaml"), two_waves_of_scans);
  ASSERT_EQ(run_cambium({"simulate", path("scans.yaml").string(), path("scans").string()}).code, 0);
  const auto scans = [](char m) { return path(std::string("scans/mission_") + m).string(); };
  const auto run = [](const std::vector<std::string>& missions, const std::string& out,
                      const std::string& cache) {
    return fuse(missions, out, cache, "p_scans.yaml");
  };
  ASSERT_EQ(run({scans('a'), scans('b')}, "scans_ab", "scanning").code, 0);
  ASSERT_EQ(run({path("scans_ab").string(), scans('c')}, "scans_grown", "scanning").code, 0);
  ASSERT_EQ(run({scans('a'), scans('b'), scans('c')}, "scans_abc", "none").code, 0);
  expect_the_same("scans_grown", "scans_abc");
  expect_only_what_is_new(read_json(path("scans_ab/report.json")),
                          read_json(path("scans_grown/report.json")));
}

// Tree tables hold bases: where one mission's gravity is wrong, they say so against it.
TEST_F(ManyMissions, AMissionWithAWrongGravityIsNamedPutRightAndBendsNoOther) {
  std::string spec = read_file(source("tests/specs/fleet.yaml"));
  const std::string name = "{name: mission_c,";
  ASSERT_NE(spec.find(name), std::string::npos);
  spec.insert(spec.find(name) + name.size(), " gravity_tilt: 12,");
  write_file(path("tilted.yaml"), spec);
  ASSERT_EQ(run_cambium({"simulate", path("tilted.yaml").string(), path("tilted").string()}).code,
            0);
  const Outcome outcome =
      run_cambium({"run", path("p.yaml").string(), path("tilted/mission_*").string(), "--out",
                   path("tilted_map").string(), "--cache", "none"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("mission 'mission_c' is not level: its vertical is 12."),
            std::string::npos)
      << outcome.err;
  const auto report = read_json(path("tilted_map/report.json"));
  EXPECT_EQ(report["islands"].size(), 1u);
  EXPECT_LE(metric(report, "loops.wrong"), 0.02 * metric(report, "loops.accepted"));
  for (const char* other : {"a", "b", "d"})
    EXPECT_LT(metric(report, std::string("ate.mission_") + other + ".own.rmse"), 0.06) << other;
  EXPECT_LT(metric(report, "ate.mission_c.own.rmse"), 0.12);
}

// A frame with z forward hides every stem: nothing ties the mission, which is said, and the others
// are where they would be without it.
TEST_F(ManyMissions, AMissionWithAWrongFrameIsAnIslandAndBendsNoOther) {
  fs::create_directories(path("frames"));
  fs::copy(mission('d'), path("frames/mission_d"), fs::copy_options::recursive);
  Mission graph = read_g2o(path("frames/mission_d/slam_pose_graph.g2o"));
  SE3 forward;
  forward.q = Quat(std::sqrt(0.5), 0, std::sqrt(0.5), 0);
  for (Node& node : graph.nodes) node.T_mission_node = forward * node.T_mission_node;
  AtomicFile file(path("frames/mission_d/slam_pose_graph.g2o"));
  write_g2o(file.stream(), graph);
  file.commit();
  const Outcome with = run_cambium({"run", path("p.yaml").string(), mission('a'), mission('b'),
                                    mission('c'), path("frames/mission_d").string(), "--out",
                                    path("framed").string(), "--cache", "none"});
  ASSERT_EQ(with.code, 0) << with.err;
  EXPECT_NE(with.err.find("2 islands: no accepted loop ties them together: {mission_a, mission_b, "
                          "mission_c} {mission_d}"),
            std::string::npos)
      << with.err;
  EXPECT_NE(
      with.err.find("mission 'mission_d': its path lies in an upright plane, whose normal is "),
      std::string::npos)
      << with.err;
  EXPECT_EQ(with.err.find("mission 'mission_a': its path"), std::string::npos) << with.err;
  ASSERT_EQ(fuse({mission('a'), mission('b'), mission('c')}, "unframed").code, 0);
  for (const char* of : {"fused.g2o", "mission_a.tum", "mission_b.tum", "mission_c.tum"})
    EXPECT_EQ(text(std::string("framed/") + of), text(std::string("unframed/") + of)) << of;
}

TEST_F(ManyMissions, TheSamePayloadsUnderAnotherNameAndGraphAreRefused) {
  fs::copy(mission('b'), path("renamed"), fs::copy_options::recursive);
  // Another graph: every pose is moved, and half of the nodes are gone.
  Mission graph = read_g2o(path("renamed/slam_pose_graph.g2o"));
  graph.nodes.resize(graph.nodes.size() / 2);
  for (Node& node : graph.nodes) node.T_mission_node.t += Vec3(1, 2, 3);
  std::erase_if(graph.edges,
                [&](const Edge& e) { return !graph.index_of(e.tail) || !graph.index_of(e.head); });
  AtomicFile file(path("renamed/slam_pose_graph.g2o"));
  write_g2o(file.stream(), graph);
  file.commit();
  const Outcome outcome = fuse({mission('a'), mission('b'), path("renamed").string()}, "copied");
  EXPECT_EQ(outcome.code, 4);
  EXPECT_NE(outcome.err.find("'mission_b' and 'renamed' are the same recording"), std::string::npos)
      << outcome.err;
  EXPECT_NE(outcome.err.find("payloads are the same to the last byte"), std::string::npos)
      << outcome.err;
  EXPECT_FALSE(fs::exists(path("copied/fused.g2o")));
}

TEST_F(ManyMissions, MissionsThatDoNotFitIntoMemoryAreRefusedWithTheFigure) {
  const Outcome outcome = run_cambium({"run", path("p.yaml").string(), mission('a'), mission('b'),
                                       "--out", path("no_room").string(), "--memory", "1"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("--memory: 2 missions take "), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("more than the 0M allowed"), std::string::npos) << outcome.err;
}

TEST_F(ManyMissions, ARunThatTakesMoreThanItsBudgetSaysSo) {
  const auto run = [](const std::string& out, const std::string& memory) {
    return run_cambium({"run", path("p.yaml").string(), mission('a'), mission('b'), mission('c'),
                        "--out", path(out).string(), "--cache", "none", "--memory", memory,
                        "--threads", "1"});  // so that two runs take the same
  };
  const Outcome roomy = run("roomy", "4G");
  ASSERT_EQ(roomy.code, 0) << roomy.err;
  EXPECT_EQ(roomy.err.find("--memory"), std::string::npos) << roomy.err;
  const auto memory = read_json(path("roomy/report.json"))["memory"];
  EXPECT_LT(memory["peak"], memory["budget"]);
  const auto most = memory["peak"].get<std::size_t>() >> 20;
  const Outcome tight = run("tight", std::to_string(most * 3 / 4) + "M");
  ASSERT_EQ(tight.code, 0) << tight.err;
  EXPECT_NE(tight.err.find("at its peak, more than --memory "), std::string::npos) << tight.err;
  EXPECT_EQ(text("tight/fused.g2o"), text("roomy/fused.g2o"));
}
