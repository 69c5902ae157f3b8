// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>

#include "engine/keys.hpp"
#include "engine/steps.hpp"

namespace cambium {
namespace {

void check(const Island& island, const Step& step) {
  for (const NodePosition& p : island.positions)
    if (!std::binary_search(island.missions.begin(), island.missions.end(), p.node.mission) ||
        !p.t_map.allFinite() || !p.information.allFinite())
      throw Error(ErrorCode::plugin, step.registered->library,
                  fmt::format("'{}' gave a position that is not finite, or of a mission that is "
                              "not of the island",
                              step.plugin));
}

}  // namespace

Known run_georeference(Known known, const StepScope& scope) {
  auto& islands = known.atlas.islands;
  std::vector<GnssAlignment> found(islands.size());
  const Configured& c = scope.step.configured;
  const Digest atlas = atlas_key(known.atlas);
  scope.run_items(islands.size(), [&](std::size_t i) {
    Making making;
    const Digest input = Hasher().add(atlas).add(std::uint64_t(i)).digest();
    found[i] = scope.cached<GnssAlignment>(c, input, making, [&](const Context& context) {
      return c.as<GnssAligner>().align(known.atlas, islands[i], context);
    });
    return making;
  });
  std::size_t tied = 0;
  for (std::size_t i = 0; i < islands.size(); ++i) {
    for (const auto& [name, value] : found[i].scores)
      scope.record.figures.emplace_back(fmt::format("island_{}.{}", i, name), value);
    if (found[i].georeference) {
      islands[i].georeference = found[i].georeference;
      islands[i].positions = std::move(found[i].positions);
      check(islands[i], scope.step);
      if (!islands[i].positions.empty())
        scope.record.figures.emplace_back(fmt::format("island_{}.positions", i),
                                          double(islands[i].positions.size()));
      ++tied;
    } else {
      const auto& first = *known.atlas.missions[islands[i].missions.front()].mission;
      scope.engine.progress().log(
          LogLevel::warning,
          fmt::format("island {} (mission {}{}) is not georeferenced: {}", i, first.name,
                      islands[i].missions.size() > 1 ? ", ..." : "", found[i].reason));
    }
  }
  scope.record.summary = fmt::format("{} of {} islands georeferenced", tied, islands.size());
  return known;
}

}  // namespace cambium
