// SPDX-License-Identifier: BSD-3-Clause
// Which pairs of missions a `recognize` step compares.
#pragma once
#include <compare>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/steps.hpp"

namespace cambium {

/// Two missions by index, the reference not after the query; the same one twice: within a mission.
struct PairOfMissions {
  std::uint32_t query = 0, reference = 0;
  friend auto operator<=>(const PairOfMissions&, const PairOfMissions&) = default;
};

struct MissionPair {
  PairOfMissions missions;
  std::vector<std::size_t> slices = {0};  ///< of its candidates, those to go on with
  std::size_t of = 1;                     ///< slices in all
  /// Whether the candidate of this number is in one of the slices.
  bool takes(std::size_t candidate) const;
};

/// `which`: within_missions, between_missions or all, as in the pipeline.
std::vector<MissionPair> mission_pairs(std::size_t count, const std::string& which);

/// Leaves out the pairs that never met, and says in the step's figures how many.
std::vector<MissionPair> that_may_meet(std::vector<MissionPair> pairs, const Atlas& atlas,
                                       const StepScope& scope);

/// Of the pairs those that the share names, each with its slices.
std::vector<MissionPair> shared(std::vector<MissionPair> pairs, const Share& share,
                                const Atlas& atlas);

}  // namespace cambium
