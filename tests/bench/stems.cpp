// SPDX-License-Identifier: BSD-3-Clause
// How well stem_extraction finds the trees of simulated forests, and how long it takes:
//   bench_stems [SUBMAP_PARAMS [STEM_EXTRACTION_PARAMS]]
// Submaps of a path of 60 m in the default stand (940 stems/ha, foliage, clutter, drift) on level
// and on sloped ground. Trees within 15 m of the node count; so does what is no tree.
#include <cstdio>
#include <ctime>

#include "bench/stem_data.hpp"
#include "cambium/statistics.hpp"
#include "support/plain_context.hpp"

namespace {

using namespace cambium;
using namespace cambium::bench;

std::string specification(int slope, int beams, int seed) {
  return "version: 1\nseed: " + std::to_string(seed) +
         "\nstand: {size: [100, 80]}\nterrain: {max_slope: " + std::to_string(slope) +
         "}\npath: {kind: line, size: [60, 0], spacing: 2}\nmissions: [{name: robot, platform: 1, "
         "sensor: {beams: " +
         std::to_string(beams) + "}}]\n";
}

double seconds() { return double(std::clock()) / CLOCKS_PER_SEC; }

struct Filters {
  std::shared_ptr<const PayloadFilter> submap, stems;
};

struct Row {
  Tally tally;
  double points = 0, submap_seconds = 0;
};

/// One node in five, where the submap is whole.
void run(const Forest& forest, const Filters& filters, Row& row) {
  const cambium::testing::PlainContext context;
  const std::size_t nodes = forest.T_world_node.size();
  for (std::size_t node = 8; node + 8 < nodes; node += 5) {
    const double start = seconds();
    Atlas atlas = forest.atlas;
    const Payload joined = filters.submap->apply({atlas, 0}, node, context);
    const double middle = seconds();
    PayloadSources sources = *atlas.payloads;
    sources[0][node] = cambium::testing::in_memory(joined);
    atlas.payloads = std::make_shared<const PayloadSources>(std::move(sources));
    const Payload found = filters.stems->apply({atlas, 0}, node, context);
    row.submap_seconds += middle - start;
    row.tally.seconds += seconds() - middle;
    row.points += double(joined.cloud->size());
    judge(forest, node, *found.trees, {}, row.tally);
  }
}

double percent(std::size_t part, std::size_t all) {
  return all ? 100.0 * double(part) / double(all) : 0.0;
}

void print(int slope, int beams, const Row& row) {
  const Tally& t = row.tally;
  const double n = double(t.nodes);
  double bias = 0;
  for (const double e : t.dbh) bias += 100 * e / double(t.dbh.size());
  std::printf(
      "| %2d | %2d | %6.0f | %5.1f | %5.1f | %5.1f | %4.2f | %5.2f | %4.2f | %4.2f | %4.2f "
      "| %4.0f | %4.0f |\n",
      slope, beams, row.points / n / 1000, percent(t.found, t.stems), percent(t.thin_found, t.thin),
      percent(t.right, t.reported), 100 * rms(t.dbh), bias, 100 * median(t.position),
      100 * rms(t.base), 57.3 * median(t.lean), 1e3 * row.submap_seconds / n, 1e3 * t.seconds / n);
}

}  // namespace

int main(int argc, char** argv) try {
  const Filters filters{
      cambium::testing::component<PayloadFilter>("submap", argc > 1 ? argv[1] : "{}"),
      cambium::testing::component<PayloadFilter>("stem_extraction", argc > 2 ? argv[2] : "{}")};
  std::printf(
      "| slope [deg] | beams | 1000 points | recall [%%] from 0.10 m | from 0.05 to 0.10 m | "
      "precision [%%] | dbh rmse [cm] | bias | position, median [cm] | base rmse [cm] | "
      "axis, median [deg] | submap [ms] | stems [ms] |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (const int slope : {0, 20})
    for (const int beams : {64, 32, 16}) {
      Row row;
      for (const int seed : {21, 22})
        run(grow_forest(specification(slope, beams, seed)), filters, row);
      print(slope, beams, row);
    }
} catch (const std::exception& e) {
  std::fprintf(stderr, "%s\n", e.what());
  return 1;
}
