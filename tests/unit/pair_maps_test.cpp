// SPDX-License-Identifier: BSD-3-Clause
// Which atlas a recogniser that uses poses is shown: that of a pair alone, or that of all.
#include <map>
#include <mutex>

#include "cambium/files.hpp"
#include "engine/run.hpp"
#include "support/support.hpp"
#include "support/trusting.hpp"

using namespace cambium;

namespace {

struct Line final : MissionReader {
  bool accepts(const std::filesystem::path&) const override { return true; }
  Mission read(const std::filesystem::path& path, const Context&) const override {
    std::vector<SE3> poses;
    for (int i = 0; i < 6; ++i) poses.push_back(SE3::from_yaw(0, {5.0 * i, 0, 0}));
    Mission m = cambium::testing::make_mission(path.stem().string(), poses);
    for (Node& node : m.nodes) node.stamp->sec += 1000 * m.name[0];
    m.digest = digest_file(path);
    return m;
  }
};

/// Ties missions whose names are neighbours in the alphabet.
struct Neighbours final : PlaceRecognizer {
  Fingerprints describe(const MissionView& m, const Context&) const override {
    return {1, 1, {float(m.mission().name[0])}, {}};
  }
  std::vector<Candidate> match(const Fingerprints& q, const Fingerprints& r, const Pairing&,
                               const Context&) const override {
    std::vector<Candidate> out;
    for (std::size_t i = 0; i < 6 && q.table[0] - r.table[0] == 1; ++i)
      out.push_back({i, i, 1.0, SE3::from_yaw(0, {0, 2, 0})});
    return out;
  }
};

std::mutex mutex;
std::map<std::string, std::size_t> shown;  // pair of missions -> missions of the atlas it is in

/// Proposes nothing; remembers what it saw.
struct Onlooker final : PlaceRecognizer {
  bool uses_poses() const override { return true; }
  Fingerprints describe(const MissionView& m, const Context&) const override {
    return {1, 2, {float(m.mission().name[0]), float(m.atlas.missions.size())}, {}};
  }
  std::vector<Candidate> match(const Fingerprints& q, const Fingerprints& r, const Pairing&,
                               const Context&) const override {
    const std::lock_guard lock(mutex);
    shown[{char(r.table[0]), char(q.table[0])}] = std::size_t(q.table[1]);
    return {};
  }
};

/// Leaves everything where it is, but only in graphs that are large enough.
struct Still final : Solver {
  int least = 0;
  bool converges = true;
  void params(ParamVisitor& v) override {
    v("least", least, "Nodes of the smallest graph that can be solved", between(0, 1000));
    v("converges", converges, "Whether two missions are enough to converge");
  }
  Solution solve(const PoseGraph& g, const Context&) const override {
    if (g.T_map_node.size() < std::size_t(least)) throw Error(ErrorCode::numeric, "", "singular");
    Solution s;
    s.T_map_node = g.T_map_node;
    s.weight.assign(g.relative.size(), 1.0);
    s.converged = converges || g.T_map_node.size() > 12;
    return s;
  }
};

std::map<std::string, std::size_t> shown_to_the_onlooker(const std::string& solver_params) {
  Registry registry;
  registry.add<Line>("line", "");
  registry.add<Neighbours>("neighbours", "");
  registry.add<Onlooker>("onlooker", "");
  registry.add<cambium::testing::TrustGuess>("trust", "");
  registry.add<cambium::testing::AcceptAll>("accept", "");
  registry.add<Still>("still", "");
  const cambium::testing::TemporaryFolder folder;
  write_file(folder / "p.yaml",
             "version: 1\nsteps:\n  - recognize: neighbours\n    pairs: between_missions\n"
             "  - register: trust\n  - verify: accept\n  - optimize: still\n    params: " +
                 solver_params + "\n  - recognize: onlooker\n    pairs: between_missions\n");
  RunOptions options;
  options.pipeline = folder / "p.yaml";
  options.out = folder / "out";
  for (const std::string name : {"a", "b", "c"}) {
    write_file(folder / (name + ".txt"), name);
    options.missions.push_back((folder / (name + ".txt")).string());
  }
  Progress progress(Progress::Style::quiet, LogLevel::error);
  const Engine engine({}, progress);
  shown.clear();
  run_pipeline(options, prepare_run(options, registry), registry, engine);
  return shown;
}

using Shown = std::map<std::string, std::size_t>;

}  // namespace

TEST(PairMaps, MissionsThatLoopsTieAreLookedAtAloneOthersInTheMapOfAll) {
  EXPECT_EQ(shown_to_the_onlooker("{}"), (Shown{{"ab", 2}, {"bc", 2}, {"ac", 3}}));
}

TEST(PairMaps, WhereAPairAloneCannotBeSolvedTheMapOfAllServes) {
  const Shown all{{"ab", 3}, {"bc", 3}, {"ac", 3}};
  EXPECT_EQ(shown_to_the_onlooker("{least: 18}"), all);
  EXPECT_EQ(shown_to_the_onlooker("{converges: false}"), all);
}
