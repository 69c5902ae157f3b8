// SPDX-License-Identifier: BSD-3-Clause
#include "verdicts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "agreement.hpp"

namespace cambium::pcm {
namespace {

class Judge {
 public:
  Judge(const PairOfMissions& pair, const Rules& rules, const Context& context)
      : pair_(pair), rules_(rules), agreement_(pair, rules, context), left_(pair.loops.size()) {
    verdicts_.resize(size());
  }

  std::vector<Verdict> judge() && {
    admit();
    agreement_.measure(left_);
    while (left_.first() != Bits::npos) {
      const auto members = agreement_.largest_set(left_);
      if (members.size() + (pair_.within ? 1 : 0) < rules_.min_clique) {
        reject_left_as_too_few(members.size());
      } else if (const double support = agreement_.supported_path(members);
                 !pair_.within && support < rules_.min_support_path) {
        reject_as_one_place(members, support);
      } else if (const auto rival = agreement_.rival_of(members, left_); !rival.empty()) {
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

  void reject_left_as_too_few(std::size_t largest) {
    for (std::size_t i; (i = left_.first()) != Bits::npos; left_.reset(i))
      verdicts_[i].reason =
          pair_.within
              ? fmt::format(
                    "agrees with the odometry, but only {} loop(s) {} agree with each "
                    "other; {} needed",
                    largest, where(pair_), rules_.min_clique - 1)
              : fmt::format("not tied: only {} of {} loops {} agree with each other, {} needed",
                            largest, size(), where(pair_), rules_.min_clique);
  }

  void reject_left_as_ambiguous(std::size_t largest, std::size_t rival) {
    for (std::size_t i; (i = left_.first()) != Bits::npos; left_.reset(i))
      verdicts_[i].reason = fmt::format(
          "not tied: {} loops {} agree with each other, but {} others over the same path agree on "
          "another place: this place repeats itself",
          largest, where(pair_), rival);
  }

  void reject_as_one_place(const Members& members, double support) {
    for (const std::size_t i : members) {
      left_.reset(i);
      verdicts_[i].reason = fmt::format(
          "consistent with {} of {} other loops {}, but they span only {:.1f} m of "
          "path, {:.1f} m needed: one place that looks like another",
          members.size() - 1, size() - 1, where(pair_), support, rules_.min_support_path);
    }
  }

  void accept(const Members& members) {
    for (const std::size_t i : members) {
      left_.reset(i);
      verdicts_[i] = {true, fmt::format("consistent with {}{} of {} other loops {}",
                                        pair_.within ? "the odometry and " : "", members.size() - 1,
                                        size() - 1, where(pair_))};
    }
    for (std::size_t i; (i = left_.first()) != Bits::npos; left_.reset(i)) {
      const std::size_t worst =
          *std::max_element(members.begin(), members.end(), [&](std::size_t a, std::size_t b) {
            return agreement_.distance(i, a) < agreement_.distance(i, b);
          });
      verdicts_[i].reason = fmt::format(
          "contradicts loop {} by {:.1f} sigma (largest clique: {} loops)", pair_.labels[worst],
          std::sqrt(agreement_.distance(i, worst)), members.size());
    }
  }

  const PairOfMissions& pair_;
  const Rules& rules_;
  Agreement agreement_;
  Bits left_;  ///< loops without a verdict yet
  std::vector<Verdict> verdicts_;
};

}  // namespace

std::vector<Verdict> judge(const PairOfMissions& pair, const Rules& rules, const Context& context) {
  return Judge(pair, rules, context).judge();
}

}  // namespace cambium::pcm
