// SPDX-License-Identifier: BSD-3-Clause
// Which loops between two missions (or within one) agree with each other.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "clique.hpp"
#include "verdicts.hpp"

namespace cambium::pcm {

using Members = std::vector<std::size_t>;  ///< indices into PairOfMissions::loops

/// "within mission_a", "between mission_a and mission_b"
std::string where(const PairOfMissions& pair);

class Agreement {
 public:
  Agreement(const PairOfMissions& pair, const Rules& rules, const Context& context)
      : pair_(pair), rules_(rules), context_(context) {}

  /// Between each two of `loops`: how far the cycle through both is from closing.
  void measure(const Bits& loops);
  double distance(std::size_t i, std::size_t j) const;  ///< squared [sigma^2]

  /// The largest set of loops among `allowed` that agree with each other.
  Members largest_set(const Bits& allowed) const;

  /// Another set among `left` that is nearly as large, and says of the same stretch of a path that
  /// it lies elsewhere; empty when there is none. Rows of a plantation give one such set for each
  /// row. Sets over different stretches are no rivals: between them the odometry may have drifted.
  Members rival_of(const Members& members, const Bits& left) const;

  /// The shorter of the two stretches of path that the loops tie together [m].
  double supported_path(const Members& members) const;

 private:
  std::size_t size() const { return pair_.loops.size(); }
  std::pair<std::size_t, std::size_t> range(const Members& members,
                                            std::size_t Measurement::*node) const;

  const PairOfMissions& pair_;
  const Rules& rules_;
  const Context& context_;
  std::vector<std::vector<float>> rows_;  ///< of the upper triangle
};

}  // namespace cambium::pcm
