// SPDX-License-Identifier: BSD-3-Clause
// What neighbours along the path say of one another's places: between them lies little drift, so
// right answers agree about where the two missions lie, and wrong ones rarely agree with anything.
#pragma once
#include <optional>
#include <vector>

#include "search.hpp"

namespace tree_match {

/// Decides by their neighbours on answers that are not sure, drops sure ones that more neighbours
/// contradict than support, and sets heights to what the neighbours say at the median. `found`: by
/// the query's nodes; the result likewise. Every node is judged by the answers as they were given.
std::vector<std::optional<Found>> by_consensus(const std::vector<std::optional<Found>>& found,
                                               const Place& query, const Place& reference,
                                               const Limits& limits);

}  // namespace tree_match
