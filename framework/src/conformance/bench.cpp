// SPDX-License-Identifier: BSD-3-Clause
#include "conformance/bench.hpp"

#include <algorithm>
#include <chrono>
#include <fstream>
#include <map>

#include "cambium/path.hpp"
#include "cambium/truth.hpp"
#include "engine/memory_use.hpp"

namespace cambium::conformance {
namespace {

constexpr double near = 5.0;  // [m]

/// The largest resident memory since reset() [bytes]; Linux keeps it (proc(5), clear_refs).
void reset_peak() { std::ofstream("/proc/self/clear_refs") << "5"; }
std::size_t peak() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmHWM:")) return std::stoul(line.substr(6)) << 10;
  return 0;
}

double mean_points(const Atlas& atlas) {
  std::size_t points = 0, clouds = 0;
  for (std::uint32_t m = 0; m < atlas.missions.size(); ++m)
    for (std::uint32_t i = 0; i < atlas.missions[m].mission->nodes.size(); ++i)
      if (const Payload p = atlas.payload({m, i}); p.cloud) points += p.cloud->size(), ++clouds;
  return clouds == 0 ? 0 : double(points) / double(clouds);
}

void recognise(const PlaceRecognizer& r, const World& world, const Context& context,
               Measured& out) {
  const Mission &query = *world.atlas.missions[1].mission,
                &reference = *world.atlas.missions[0].mission;
  const auto a = r.describe({world.atlas, 1}, context), b = r.describe({world.atlas, 0}, context);
  const Pairing pairing{false, 0, travelled(query), travelled(reference)};
  std::map<std::size_t, Candidate> best;
  for (const Candidate& c : r.match(a, b, pairing, context)) {
    const auto [it, fresh] = best.emplace(c.query, c);
    if (!fresh && c.score > it->second.score) it->second = c;
  }
  const auto distance = [&](std::size_t q, std::size_t i) {
    return (world.T_world_node[1][q].t - world.T_world_node[0][i].t).norm();
  };
  std::size_t able = 0, right = 0;
  for (std::size_t q = 0; q < query.nodes.size(); ++q) {
    bool has = false;
    for (std::size_t i = 0; i < reference.nodes.size(); ++i) has |= distance(q, i) < near;
    able += has;
    const auto found = best.find(q);
    right += found != best.end() && distance(q, found->second.reference) < near;
  }
  if (able > 0) out.recall = double(right) / double(able);
  if (!best.empty()) out.precision = double(right) / double(best.size());
}

}  // namespace

const char* use_of(Kind kind) {
  switch (kind) {
    case Kind::mission_reader:
      return "reads one small pose graph";
    case Kind::payload_filter:
      return "filters 3 payloads of each mission";
    case Kind::place_recognizer:
      return "describes 4 missions, matches a pair of missions and one with itself";
    case Kind::registration:
      return "prepares 2 payloads, aligns 1 pair";
    case Kind::loop_verifier:
      return "judges all loops";
    case Kind::solver:
      return "solves the graph";
    case Kind::gnss_aligner:
      return "aligns the island";
    case Kind::map_exporter:
      return "writes the map";
    case Kind::evaluator:
      return "measures the map";
  }
  return "";
}

World thinned(const World& world, std::size_t step) {
  World out = world;
  out.atlas = with_payloads(world.atlas, [step](NodeRef, const Payload& p) {
    Payload fewer = p;
    if (!p.cloud) return fewer;
    std::vector<std::size_t> kept;
    for (std::size_t i = 0; i < p.cloud->size(); i += step) kept.push_back(i);
    fewer.cloud = std::make_shared<const Cloud>(select(*p.cloud, kept));
    return fewer;
  });
  return out;
}

Measured measure(const Registered& registered, const Registry& registry, const World& world,
                 double seconds) {
  Measured out;
  out.component = registered.name;
  out.points = mean_points(world.atlas);
  try {
    const Host host(1);
    const auto context = host.context();
    const Subject subject{registered, registry, registered.create(), world};
    const Exercise use = exercise(subject);
    const std::size_t before = resident_bytes();
    reset_peak();
    std::vector<double> times;
    double spent = 0;
    while (times.size() < 3 || (spent < seconds && times.size() < 1000)) {
      const auto begin = std::chrono::steady_clock::now();
      use.usual(*context);
      const std::chrono::duration<double> time = std::chrono::steady_clock::now() - begin;
      times.push_back(time.count());
      spent += time.count();
    }
    std::ranges::sort(times);
    out.uses = times.size();
    out.milliseconds = 1e3 * times[times.size() / 2];
    out.megabytes = double(std::max(peak(), before) - before) / (1 << 20);
    if (registered.kind == Kind::place_recognizer)
      recognise(subject.as<PlaceRecognizer>(), world, *context, out);
  } catch (const Cancelled&) {
    throw;
  } catch (const std::exception& e) {  // one that wants other payloads does not end the table
    out.refusal = e.what();
  }
  return out;
}

World world_of(Atlas atlas) {
  World out;
  const Truth truth = read_truth(atlas, {}, 0.01);
  for (std::size_t m = 0; m < atlas.missions.size(); ++m) {
    const auto& poses = *atlas.missions[m].T_map_node;
    out.T_world_node.emplace_back();
    for (std::size_t i = 0; i < poses.size(); ++i)
      out.T_world_node[m].push_back(truth.T_world_node[m][i].value_or(poses[i]));
  }
  out.atlas = std::move(atlas);
  return out;
}

}  // namespace cambium::conformance
