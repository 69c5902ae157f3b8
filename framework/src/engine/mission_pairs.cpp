// SPDX-License-Identifier: BSD-3-Clause
#include "engine/mission_pairs.hpp"

#include <algorithm>

#include "engine/meeting.hpp"

namespace cambium {

bool MissionPair::takes(std::size_t candidate) const {
  return std::find(slices.begin(), slices.end(), candidate % of) != slices.end();
}

std::vector<MissionPair> mission_pairs(std::size_t count, const std::string& which) {
  std::vector<MissionPair> pairs;
  for (std::uint32_t query = 0; query < count; ++query)
    for (std::uint32_t reference = 0; reference <= query; ++reference)
      if (which == "all" || (query == reference) == (which == "within_missions"))
        pairs.push_back({{query, reference}});
  return pairs;
}

std::vector<MissionPair> that_may_meet(std::vector<MissionPair> pairs, const Atlas& atlas,
                                       const StepScope& scope) {
  const Meetings meetings(atlas, scope.step.keys.max_distance);
  const std::size_t all = pairs.size();
  std::size_t by_gnss = 0, by_map = 0;
  std::erase_if(pairs, [&](const MissionPair& pair) {
    const auto apart = meetings.apart(pair.missions.query, pair.missions.reference);
    by_gnss += apart == Meetings::Apart::by_gnss;
    by_map += apart == Meetings::Apart::by_map;
    return apart != Meetings::Apart::no;
  });
  scope.record.figures = {{"mission_pairs", double(all)},
                          {"mission_pairs.compared", double(pairs.size())},
                          {"mission_pairs.apart_by_gnss", double(by_gnss)},
                          {"mission_pairs.apart_by_map", double(by_map)}};
  return pairs;
}

std::vector<MissionPair> shared(std::vector<MissionPair> pairs, const Share& share,
                                const Atlas& atlas) {
  const auto name = [&](std::uint32_t m) { return atlas.missions[m].mission->name; };
  for (MissionPair& pair : pairs) {
    pair.slices.clear();
    for (const SharePart& part : share.parts) {
      if (part.query != name(pair.missions.query) ||
          part.reference != name(pair.missions.reference))
        continue;
      pair.slices.push_back(part.slice);
      pair.of = part.slices;
    }
  }
  std::erase_if(pairs, [](const MissionPair& pair) { return pair.slices.empty(); });
  return pairs;
}

}  // namespace cambium
