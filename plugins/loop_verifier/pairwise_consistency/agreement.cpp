// SPDX-License-Identifier: BSD-3-Clause
#include "agreement.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace cambium::pcm {

std::string where(const PairOfMissions& pair) {
  return pair.within ? "within " + pair.tail_name
                     : "between " + pair.tail_name + " and " + pair.head_name;
}

void Agreement::measure(const Bits& loops) {
  rows_.resize(size());
  context_.parallel_for(size(), [&](std::size_t i) {
    context_.check_cancelled();
    if (!loops.test(i)) return;
    rows_[i].assign(size() - i, 0.0f);
    for (std::size_t j = i + 1; j < size(); ++j)
      if (loops.test(j))
        rows_[i][j - i] =
            float(cycle_distance(pair_.loops[i], pair_.loops[j], *pair_.tails, *pair_.heads));
  });
}

double Agreement::distance(std::size_t i, std::size_t j) const {
  return double(rows_[std::min(i, j)][std::max(i, j) - std::min(i, j)]);
}

Members Agreement::largest_set(const Bits& allowed) const {
  CliqueProblem problem;
  problem.neighbours.assign(size(), Bits(size()));
  for (std::size_t i = 0; i < size(); ++i)
    for (std::size_t j = i + 1; j < size(); ++j)
      if (allowed.test(i) && allowed.test(j) && distance(i, j) <= rules_.gate) {
        problem.neighbours[i].set(j);
        problem.neighbours[j].set(i);
      }
  problem.distance = [this](std::size_t i, std::size_t j) { return distance(i, j); };
  problem.branch_limit = rules_.branch_limit;
  problem.check_cancelled = [this] { context_.check_cancelled(); };
  Clique clique = maximum_clique(problem, allowed);
  if (!clique.exact)
    context_.warn(fmt::format(
        "loops {}: the search for the largest consistent set stopped after {} branches with {} "
        "of {} loops; a larger set may exist (raise branch_limit, or lower probability)",
        where(pair_), rules_.branch_limit, clique.members.size(), size()));
  return clique.members;
}

Members Agreement::rival_of(const Members& members, const Bits& left) const {
  if (pair_.within) return {};
  Bits contradicting(size());
  for (std::size_t i = 0; i < size(); ++i)
    if (left.test(i) && std::ranges::all_of(members, [&](std::size_t m) {
          return m != i && distance(i, m) > rules_.gate;
        }))
      contradicting.set(i);
  if (contradicting.first() == Bits::npos) return {};
  const auto rival = largest_set(contradicting);
  const auto overlap = [&](std::size_t Measurement::*node) {
    const auto [low, high] = range(members, node);
    const auto [rival_low, rival_high] = range(rival, node);
    return rival_low <= high && low <= rival_high;
  };
  const bool comparable = double(rival.size()) > rules_.max_rival * double(members.size()) &&
                          rival.size() > 1 && supported_path(rival) >= rules_.min_support_path;
  return comparable && (overlap(&Measurement::tail) || overlap(&Measurement::head)) ? rival
                                                                                    : Members{};
}

double Agreement::supported_path(const Members& members) const {
  const auto [tail_low, tail_high] = range(members, &Measurement::tail);
  const auto [head_low, head_high] = range(members, &Measurement::head);
  return std::min(pair_.tails->length(tail_low, tail_high),
                  pair_.heads->length(head_low, head_high));
}

std::pair<std::size_t, std::size_t> Agreement::range(const Members& members,
                                                     std::size_t Measurement::*node) const {
  std::size_t low = pair_.loops[members.front()].*node, high = low;
  for (const std::size_t i : members) {
    low = std::min(low, pair_.loops[i].*node);
    high = std::max(high, pair_.loops[i].*node);
  }
  return {low, high};
}

}  // namespace cambium::pcm
