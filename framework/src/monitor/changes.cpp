// SPDX-License-Identifier: BSD-3-Clause
#include "monitor/changes.hpp"

#include <fmt/format.h>

#include "cambium/error.hpp"
#include "monitor/heights.hpp"

namespace cambium::monitor {

const char* to_string(Change change) {
  switch (change) {
    case Change::kept:
      return "kept";
    case Change::gone:
      return "gone";
    case Change::appeared:
      return "new";
    case Change::overlooked:
      return "overlooked";
    case Change::unsure:
      return "unsure";
  }
  return "?";
}

std::uint32_t island_of(const Survey& survey) {
  const auto& missions = survey.clouds.missions;
  const std::uint32_t island = missions[survey.missions.front()].island;
  for (const std::uint32_t m : survey.missions)
    if (missions[m].island != island)
      throw Error(
          ErrorCode::config, survey.name,
          fmt::format("its missions '{}' and '{}' are in islands without a common map; name "
                      "one mission as RUN:MISSION",
                      missions[survey.missions.front()].mission->name, missions[m].mission->name));
  return island;
}

Changes changes(const Survey& before, const Survey& after, const ChangesOptions& options,
                const Context& context) {
  const auto trees = [&](const Survey& s) {
    island_of(s);
    if (!s.has_trees)
      context.warn(s.name +
                   ": no node has a tree table, so trees are not compared; run a pipeline "
                   "with the filter stem_extraction");
    return s.has_trees ? stems_of(s.trees, s.missions, options.stems, context)
                       : std::vector<Stem>{};
  };
  const auto stems_before = trees(before), stems_after = trees(after);
  Changes out;
  align(before, after, stems_before, stems_after, out);
  if (before.has_trees && after.has_trees)
    out.stems = compare_stems(before, after, stems_before, stems_after, out.T_before_after, options,
                              context);
  out.cells = compare_heights(before, after, out.T_before_after, options.cells, context);
  if (out.stems.empty() && out.cells.empty())
    throw Error(ErrorCode::check, after.name,
                fmt::format("has no tree and no ground where '{}' has some: nothing to compare",
                            before.name));
  return out;
}

}  // namespace cambium::monitor
