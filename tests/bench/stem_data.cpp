// SPDX-License-Identifier: BSD-3-Clause
#include "bench/stem_data.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <sstream>
#include <tuple>

#include "simulate/sensor.hpp"
#include "simulate/spec_file.hpp"
#include "support/plain_context.hpp"

namespace cambium::bench {
namespace {

constexpr double breast_height = 1.3;  // [m]

Vec3 at_breast_height(const Vec3& base, const Vec3& axis) { return base + breast_height * axis; }

double across(const Vec3& a, const Vec3& b) { return (a - b).head<2>().norm(); }

}  // namespace

Forest grow_forest(const std::string& specification) {
  using namespace simulate;
  const SimulationSpec spec = parse_spec(specification, "bench_stems");
  const auto seed = std::uint64_t(spec.seed);
  Forest out;
  const Terrain& terrain = out.terrain = make_terrain(spec.terrain, spec.stand.size, seed);
  out.stems = plant(spec.stand, terrain, seed);
  const auto clutter = scatter_clutter(spec.clutter, spec.stand, terrain, seed);
  Recording r = record(spec, 0, terrain, out.stems, clutter);
  const Scene scene(terrain, r.stems, clutter,
                    grow(spec.foliage, spec.stand, terrain, r.stems, seed));
  const Lidar lidar(r.spec.sensor);
  for (std::size_t i = 0; i < r.truth.size(); ++i) {
    const SE3& T_world_node = r.truth[i].T_world_base;
    out.T_world_node.push_back(T_world_node);
    r.mission.nodes[i].payload =
        testing::in_memory(lidar.scan(scene, T_world_node, Random(r.seed, "scan", i)));
  }
  out.atlas = testing::make_atlas({std::move(r.mission)});
  return out;
}

std::string specification(const Walk& w) {
  std::ostringstream out;
  out << "version: 1\nseed: " << w.seed
      << "\nstand: {size: [100, 80]}\nterrain: {max_slope: " << w.slope
      << "}\npath: {kind: line, size: [60, 0], spacing: 2}\nmissions: [{name: robot, "
      << "platform: 1, odometry: {drift: " << w.drift << "}, sensor: {beams: " << w.beams
      << "}}]\n";
  return out.str();
}

Payload filtered(const Forest& forest, std::size_t node, const PayloadFilter& filter,
                 double& seconds) {
  const testing::PlainContext context;
  const std::clock_t start = std::clock();
  Payload out = filter.apply({forest.atlas, 0}, node, context);
  seconds += double(std::clock() - start) / CLOCKS_PER_SEC;
  return out;
}

Forest with_payload(const Forest& forest, std::size_t node, Payload payload) {
  Forest out = forest;
  PayloadSources sources = *forest.atlas.payloads;
  sources[0][node] = testing::in_memory(std::move(payload));
  out.atlas.payloads = std::make_shared<const PayloadSources>(std::move(sources));
  return out;
}

void judge(const Forest& forest, std::size_t node, const std::vector<Tree>& trees,
           const Judging& judging, Tally& tally) {
  const SE3& T = forest.T_world_node[node];
  std::vector<Vec3> reported, true_ones;
  for (const Tree& t : trees) reported.push_back(T * at_breast_height(t.base, t.axis));
  for (const auto& s : forest.stems) true_ones.push_back(at_breast_height(s.base, s.axis));
  std::vector<std::tuple<double, std::size_t, std::size_t>> pairs;
  for (std::size_t i = 0; i < reported.size(); ++i)
    for (std::size_t k = 0; k < true_ones.size(); ++k)
      if (const double d = across(reported[i], true_ones[k]); d < judging.radius)
        pairs.emplace_back(d, i, k);
  std::sort(pairs.begin(), pairs.end());
  constexpr std::size_t nobody = ~std::size_t(0);
  std::vector<std::size_t> stem_of(reported.size(), nobody), tree_of(true_ones.size(), nobody);
  for (const auto& [d, i, k] : pairs)
    if (stem_of[i] == nobody && tree_of[k] == nobody) stem_of[i] = k, tree_of[k] = i;
  ++tally.nodes;
  for (std::size_t k = 0; k < true_ones.size(); ++k) {
    if (across(true_ones[k], T.t) > judging.range || forest.stems[k].dbh < judging.min_dbh)
      continue;
    const bool found = tree_of[k] != nobody;
    if (forest.stems[k].dbh >= judging.counted_dbh)
      ++tally.stems, tally.found += found;
    else
      ++tally.thin, tally.thin_found += found;
  }
  for (std::size_t i = 0; i < reported.size(); ++i) {
    if (across(reported[i], T.t) > judging.range) continue;
    const simulate::Stem* s = stem_of[i] == nobody ? nullptr : &forest.stems[stem_of[i]];
    const double error = s ? trees[i].dbh - s->dbh : 0;
    const bool sapling = s && s->dbh < judging.min_dbh;
    if (sapling && error < judging.sapling_error) continue;
    ++tally.reported;
    if (!s || sapling) continue;
    ++tally.right;
    if (std::isfinite(error)) tally.dbh.push_back(error);
    tally.position.push_back(across(reported[i], true_ones[stem_of[i]]));
    tally.base.push_back((T * trees[i].base).z() - s->base.z());
    tally.lean.push_back(std::acos(std::min(1.0, (T.q * trees[i].axis).dot(s->axis))));
  }
}

}  // namespace cambium::bench
