// SPDX-License-Identifier: BSD-3-Clause
// The verdicts on the loops between one pair of missions (or within one).
#pragma once
#include <string>
#include <vector>

#include "cambium/kinds.hpp"
#include "consistency.hpp"

namespace cambium::pcm {

struct Rules {
  double gate = 0;               ///< squared Mahalanobis distance up to which loops agree
  std::size_t min_clique = 0;    ///< loops; within a mission the odometry counts as one
  double min_support_path = 0;   ///< [m], not within a mission
  double max_rival = 1;          ///< size of a contradicting set, as a share; not within a mission
  std::size_t branch_limit = 0;  ///< of the clique search
};

struct PairOfMissions {
  std::string tail_name, head_name;
  const Path* tails = nullptr;
  const Path* heads = nullptr;
  bool within = false;              ///< both are one mission
  std::vector<Measurement> loops;   ///< in canonical order
  std::vector<std::string> labels;  ///< "12-45": node ids
};

/// One verdict for each loop, in their order.
std::vector<Verdict> judge(const PairOfMissions& pair, const Rules& rules, const Context& context);

}  // namespace cambium::pcm
