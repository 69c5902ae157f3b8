// SPDX-License-Identifier: BSD-3-Clause
#include "verdicts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "clique.hpp"

namespace cambium::pcm {
namespace {

class Judge {
 public:
  Judge(const PairOfMissions& pair, const Rules& rules, const Context& context)
      : pair_(pair), rules_(rules), context_(context), left_(pair.loops.size()) {
    verdicts_.resize(size());
  }

  std::vector<Verdict> judge() && {
    admit();
    measure_distances();
    while (left_.first() != Bits::npos) {
      const auto members = search(left_);
      if (members.size() + (pair_.within ? 1 : 0) < rules_.min_clique) {
        reject_left_as_too_few(members.size());
      } else if (const double support = supported_path(members);
                 !pair_.within && support < rules_.min_support_path) {
        reject_as_one_place(members, support);
      } else if (const auto rival = rival_of(members); !rival.empty()) {
        reject_left_as_ambiguous(members.size(), rival.size());
      } else {
        accept(members);
        break;
      }
    }
    return std::move(verdicts_);
  }

 private:
  std::size_t size() const { return pair_.loops.size(); }

  std::string where() const {
    return pair_.within ? "within " + pair_.tail_name
                        : "between " + pair_.tail_name + " and " + pair_.head_name;
  }

  /// Loops that are sound on their own stay in left_.
  void admit() {
    for (std::size_t i = 0; i < size(); ++i) {
      const Measurement& loop = pair_.loops[i];
      if (!loop.T_tail_head.finite() || !loop.covariance.allFinite()) {
        verdicts_[i].reason = "its transform or its information is not finite";
        continue;
      }
      const double d2 = pair_.within ? odometry_distance(loop, *pair_.tails) : 0;
      if (d2 <= rules_.gate)
        left_.set(i);
      else
        verdicts_[i].reason =
            fmt::format("contradicts the odometry by {:.1f} sigma over {:.0f} m of path",
                        std::sqrt(d2), pair_.tails->length(loop.tail, loop.head));
    }
  }

  /// Row by row of the upper triangle, side by side.
  void measure_distances() {
    rows_.resize(size());
    context_.parallel_for(size(), [&](std::size_t i) {
      context_.check_cancelled();
      if (!left_.test(i)) return;
      rows_[i].assign(size() - i, 0.0f);
      for (std::size_t j = i + 1; j < size(); ++j)
        if (left_.test(j))
          rows_[i][j - i] =
              float(cycle_distance(pair_.loops[i], pair_.loops[j], *pair_.tails, *pair_.heads));
    });
  }

  /// Squared, between two loops that are left.
  double distance(std::size_t i, std::size_t j) const {
    return double(rows_[std::min(i, j)][std::max(i, j) - std::min(i, j)]);
  }

  /// The largest set of loops among `allowed` that agree with each other.
  std::vector<std::size_t> search(const Bits& allowed) const {
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
          where(), rules_.branch_limit, clique.members.size(), size()));
    return clique.members;
  }

  /// Another set that is nearly as large, and says of the same stretch of a path that it lies
  /// elsewhere; empty when there is none. Rows of a plantation give one such set for each row. Sets
  /// over different stretches are no rivals: between them the odometry may have drifted.
  std::vector<std::size_t> rival_of(const std::vector<std::size_t>& members) const {
    if (pair_.within) return {};
    Bits contradicting(size());
    for (std::size_t i = 0; i < size(); ++i)
      if (left_.test(i) && std::ranges::all_of(members, [&](std::size_t m) {
            return m != i && distance(i, m) > rules_.gate;
          }))
        contradicting.set(i);
    if (contradicting.first() == Bits::npos) return {};
    const auto rival = search(contradicting);
    const auto overlap = [&](std::size_t Measurement::*node) {
      const auto [low, high] = range(members, node);
      const auto [rival_low, rival_high] = range(rival, node);
      return rival_low <= high && low <= rival_high;
    };
    const bool comparable = double(rival.size()) > rules_.max_rival * double(members.size()) &&
                            rival.size() > 1 && supported_path(rival) >= rules_.min_support_path;
    return comparable && (overlap(&Measurement::tail) || overlap(&Measurement::head))
               ? rival
               : std::vector<std::size_t>{};
  }

  /// The shorter of the two stretches of path that the loops tie together [m].
  double supported_path(const std::vector<std::size_t>& members) const {
    const auto [tail_low, tail_high] = range(members, &Measurement::tail);
    const auto [head_low, head_high] = range(members, &Measurement::head);
    return std::min(pair_.tails->length(tail_low, tail_high),
                    pair_.heads->length(head_low, head_high));
  }

  std::pair<std::size_t, std::size_t> range(const std::vector<std::size_t>& members,
                                            std::size_t Measurement::*node) const {
    std::size_t low = pair_.loops[members.front()].*node, high = low;
    for (const std::size_t i : members) {
      low = std::min(low, pair_.loops[i].*node);
      high = std::max(high, pair_.loops[i].*node);
    }
    return {low, high};
  }

  void reject_left_as_too_few(std::size_t largest) {
    for (std::size_t i; (i = left_.first()) != Bits::npos; left_.reset(i))
      verdicts_[i].reason =
          pair_.within
              ? fmt::format(
                    "agrees with the odometry, but only {} loop(s) {} agree with each "
                    "other; {} needed",
                    largest, where(), rules_.min_clique - 1)
              : fmt::format("not tied: only {} of {} loops {} agree with each other, {} needed",
                            largest, size(), where(), rules_.min_clique);
  }

  void reject_left_as_ambiguous(std::size_t largest, std::size_t rival) {
    for (std::size_t i; (i = left_.first()) != Bits::npos; left_.reset(i))
      verdicts_[i].reason = fmt::format(
          "not tied: {} loops {} agree with each other, but {} others over the same path agree on "
          "another place: this place repeats itself",
          largest, where(), rival);
  }

  void reject_as_one_place(const std::vector<std::size_t>& members, double support) {
    for (const std::size_t i : members) {
      left_.reset(i);
      verdicts_[i].reason = fmt::format(
          "consistent with {} of {} other loops {}, but they span only {:.1f} m of "
          "path, {:.1f} m needed: one place that looks like another",
          members.size() - 1, size() - 1, where(), support, rules_.min_support_path);
    }
  }

  void accept(const std::vector<std::size_t>& members) {
    for (const std::size_t i : members) {
      left_.reset(i);
      verdicts_[i] = {true, fmt::format("consistent with {}{} of {} other loops {}",
                                        pair_.within ? "the odometry and " : "", members.size() - 1,
                                        size() - 1, where())};
    }
    for (std::size_t i; (i = left_.first()) != Bits::npos; left_.reset(i)) {
      const std::size_t worst = *std::max_element(
          members.begin(), members.end(),
          [&](std::size_t a, std::size_t b) { return distance(i, a) < distance(i, b); });
      verdicts_[i].reason =
          fmt::format("contradicts loop {} by {:.1f} sigma (largest clique: {} loops)",
                      pair_.labels[worst], std::sqrt(distance(i, worst)), members.size());
    }
  }

  const PairOfMissions& pair_;
  const Rules& rules_;
  const Context& context_;
  Bits left_;  ///< loops without a verdict yet
  std::vector<std::vector<float>> rows_;
  std::vector<Verdict> verdicts_;
};

}  // namespace

std::vector<Verdict> judge(const PairOfMissions& pair, const Rules& rules, const Context& context) {
  return Judge(pair, rules, context).judge();
}

}  // namespace cambium::pcm
