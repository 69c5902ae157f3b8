// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <set>

#include "cambium/files.hpp"
#include "conformance/law.hpp"

namespace cambium::conformance {
namespace {

namespace fs = std::filesystem;

/// The truth of the kit's missions, as `reference` folder.
fs::path write_truth(const World& world, const Context& context) {
  const fs::path folder = context.scratch() / "conformance_truth";
  fs::create_directories(folder);
  for (std::size_t m = 0; m < world.atlas.missions.size(); ++m) {
    const Mission& mission = *world.atlas.missions[m].mission;
    std::vector<StampedPose> rows;
    for (std::size_t i = 0; i < mission.nodes.size(); ++i)
      rows.push_back({*mission.nodes[i].stamp, world.T_world_node[m][i]});
    write_file(folder / (mission.name + ".tum"), format_tum(rows));
  }
  return folder;
}

std::string evaluate(const Subject& s, const Atlas& atlas, const fs::path& truth,
                     const Context& context) {
  std::set<std::string> names;
  std::string out;
  for (const Metric& m : s.as<Evaluator>().evaluate(atlas, truth, context)) {
    require(m.name.starts_with(s.registered.name + "."),
            fmt::format("a metric '{}'; expected a name that starts with '{}.'", m.name,
                        s.registered.name));
    require(names.insert(m.name).second, fmt::format("two metrics '{}'", m.name));
    require(std::isfinite(m.value),
            fmt::format("'{}' is {}; leave out what cannot be measured", m.name, m.value));
    out += m.name + encode(m.value) + m.unit;
  }
  return out;
}

}  // namespace

Exercise exercise_evaluator(const Subject& s) {
  const auto on = [&s](Atlas atlas, bool truth) -> Call {
    return [&s, truth, atlas = std::move(atlas)](const Context& c) {
      return evaluate(s, atlas, truth ? write_truth(s.world, c) : fs::path(), c);
    };
  };
  Exercise e;
  e.usual = on(s.world.atlas, true);
  for (const OddPayload& odd : odd_payloads())
    e.odd.emplace_back(
        "missions of " + odd.name,
        on(with_payloads(s.world.atlas, [&odd](NodeRef, const Payload&) { return odd.payload; }),
           true));
  e.odd.emplace_back("missions of one node", on(first_nodes(s.world.atlas, 1), true));
  Atlas untied = s.world.atlas;
  untied.loops.clear();
  e.odd.emplace_back("a map without loops", on(untied, true));
  e.odd.emplace_back("no truth", on(s.world.atlas, false));
  return e;
}

}  // namespace cambium::conformance
