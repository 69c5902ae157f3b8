// SPDX-License-Identifier: BSD-3-Clause
// What the engine itself costs: a step of many work items that do nothing, computed and then taken
// from the cache.  usage: bench_engine [ITEMS] [THREADS]
#include <fmt/format.h>

#include <chrono>
#include <filesystem>

#include "engine/engine.hpp"
#include "engine/steps.hpp"
#include "support/support.hpp"
#include "support/trusting.hpp"

namespace {

using namespace cambium;

// A mission whose every node is a candidate to every other one, until there are enough.
Known many_candidates(std::size_t count) {
  std::vector<SE3> poses;
  while (poses.size() * (poses.size() - 1) / 2 < count)
    poses.push_back(SE3::from_yaw(0, {double(poses.size()), 0, 0}));
  Known known;
  known.atlas = cambium::testing::make_atlas({cambium::testing::make_mission("m", poses)});
  for (std::uint32_t head = 1; head < poses.size(); ++head)
    for (std::uint32_t tail = 0; tail < head && known.atlas.loops.size() < count; ++tail) {
      Loop loop;
      loop.tail = {0, tail};
      loop.head = {0, head};
      loop.has_guess = true;  // another one each, so that no two items are the same
      loop.T_tail_head = SE3::from_yaw(0, {double(known.atlas.loops.size()), 0, 0});
      known.atlas.loops.push_back(loop);
    }
  return known;
}

void run(const Known& known, const Step& step, const Engine& engine, const char* what) {
  StepRecord record;
  const auto begin = std::chrono::steady_clock::now();
  run_register(known, {step, engine, 1, {}, record});
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
  fmt::print("{:<20} {:>8} items {:>8.3f} s {:>8.1f} us an item, {} from the cache\n", what,
             record.items, spent.count(), 1e6 * spent.count() / double(record.items),
             record.cached);
}

}  // namespace

int main(int argc, char** argv) {
  const Known known = many_candidates(argc > 1 ? std::stoul(argv[1]) : 20000);
  const cambium::testing::TemporaryFolder folder;
  Progress progress(Progress::Style::quiet);
  EngineOptions options;
  options.threads = argc > 2 ? std::stoi(argv[2]) : 1;
  options.cache = folder / "cache";
  const Engine engine(options, progress);
  Registry registry;
  registry.add<cambium::testing::TrustGuess>("nothing", "");
  Step step;
  step.verb = find_verb("register");
  step.plugin = "nothing";
  Diagnostics diagnostics;
  step.configured = *configure(registry, Kind::registration, "nothing", "", Yaml{}, diagnostics);
  run(known, step, engine, "computed");
  run(known, step, engine, "from the cache");
}
