// SPDX-License-Identifier: BSD-3-Clause
// How well stem_extraction finds the trees of simulated forests, and how long it takes:
//   bench_stems [DRIFT_PERCENT [SEEDS [FIRST_SEED]]]
// Two ways: "submap" is the filter submap, then stem_extraction on what it joined; "aligned" is
// stem_extraction {join_radius: 15}, which joins the same scans and aligns them on the stems.
// Trees within 15 m of the node count; so does what is no tree.
#include <cstdio>
#include <cstdlib>

#include "bench/stem_data.hpp"
#include "cambium/statistics.hpp"

namespace {

using namespace cambium;
using namespace cambium::bench;
using cambium::testing::component;

struct Row {
  Tally tally;
  double points = 0, submap_seconds = 0;
};

struct Filters {
  std::shared_ptr<const PayloadFilter> submap = component<PayloadFilter>("submap"),
                                       stems = component<PayloadFilter>("stem_extraction"),
                                       aligned = component<PayloadFilter>("stem_extraction",
                                                                          "{join_radius: 15}");
};

/// One node in five, where the submap is whole.
void run(const Forest& forest, const Filters& filters, Row& submap, Row& aligned) {
  const std::size_t nodes = forest.T_world_node.size();
  for (std::size_t node = 8; node + 8 < nodes; node += 5) {
    const Payload joined = filtered(forest, node, *filters.submap, submap.submap_seconds);
    submap.points += double(joined.cloud->size());
    const Forest with = with_payload(forest, node, joined);
    judge(forest, node, *filtered(with, node, *filters.stems, submap.tally.seconds).trees, {},
          submap.tally);
    for (std::size_t i = node - 7; i <= node + 7; ++i)
      aligned.points += double(forest.atlas.payload({0, std::uint32_t(i)}).cloud->size());
    judge(forest, node, *filtered(forest, node, *filters.aligned, aligned.tally.seconds).trees, {},
          aligned.tally);
  }
}

double percent(std::size_t part, std::size_t all) {
  return all ? 100.0 * double(part) / double(all) : 0.0;
}

void print(const Walk& walk, const char* way, const Row& row) {
  const Tally& t = row.tally;
  const double n = double(t.nodes);
  double bias = 0;
  for (const double e : t.dbh) bias += e / double(t.dbh.size());
  std::printf(
      "| %d | %d | %s | %.0f | %.1f | %.1f | %.1f | %.2f | %.2f | %.1f | %.1f | %.2f | %.0f "
      "| %.0f |\n",
      walk.slope, walk.beams, way, row.points / n / 1000, percent(t.found, t.stems),
      percent(t.thin_found, t.thin), percent(t.right, t.reported), 100 * rms(t.dbh), 100 * bias,
      100 * median(t.position), 100 * rms(t.base), 57.3 * median(t.lean),
      1e3 * row.submap_seconds / n, 1e3 * t.seconds / n);
}

}  // namespace

int main(int argc, char** argv) try {
  const double drift = argc > 1 ? std::atof(argv[1]) : 0.5;
  const int seeds = argc > 2 ? std::atoi(argv[2]) : 2;
  const int first = argc > 3 ? std::atoi(argv[3]) : 21;  // extraction was tuned on 21 and 22
  const Filters filters;
  std::printf(
      "| slope [deg] | beams | way | 1000 points | recall, dbh >= 0.10 m [%%] | recall, 0.05 "
      "to 0.10 m [%%] | precision [%%] | dbh rmse [cm] | dbh bias [cm] | position, median "
      "[cm] | base rmse [cm] | axis, median [deg] | submap [ms] | stems [ms] |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (const int slope : {0, 20})
    for (const int beams : {64, 32, 16}) {
      Row submap, aligned;
      for (int seed = 0; seed < seeds; ++seed)
        run(grow_forest(specification({slope, beams, drift, first + seed})), filters, submap,
            aligned);
      print({slope, beams, drift, 0}, "submap", submap);
      print({slope, beams, drift, 0}, "aligned", aligned);
      std::fflush(stdout);
    }
} catch (const std::exception& e) {
  std::fprintf(stderr, "%s\n", e.what());
  return 1;
}
