// SPDX-License-Identifier: BSD-3-Clause
#include "search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <tuple>

namespace scan_context {
namespace {

using Block = Correlator::Range;

// Blocks keep the matrices of one thread below 2 MB (60 sectors). They do not depend on the number
// of threads, so neither do the rounding errors.
constexpr std::size_t query_block = 16, reference_block = 256;

// The vertex of the parabola through three samples one apart, relative to the middle one. Turns the
// yaw of the sector grid into a finer one.
double parabola_vertex(double left, double middle, double right) {
  const double curvature = left - 2.0 * middle + right;
  if (!std::isfinite(curvature) || curvature <= 0.0) return 0.0;
  return std::clamp(0.5 * (left - right) / curvature, -0.5, 0.5);
}

class PairScorer {
 public:
  PairScorer(const Spectra& query, const Spectra& reference, std::size_t q, const Limits& limits)
      : reference_(reference),
        overlap_(query, q),
        query_is_full_(query.filled_count(q) == query.sectors()),
        least_columns_(std::max(1.0, std::ceil(limits.min_overlap * query.sectors()))),
        distance_(std::size_t(query.sectors())) {}

  /// `sums` holds S(k). Nothing when no shift has enough columns in common.
  std::optional<Match> score(const float* sums, std::size_t r) {
    const std::size_t sectors = distance_.size();
    std::size_t best = 0;
    for (std::size_t k = 0; k < sectors; ++k) {
      const int n = columns_in_common(k, r);
      distance_[k] = n < least_columns_ ? std::numeric_limits<double>::infinity()
                                        : std::max(0.0, 1.0 - double(sums[k]) / n);
      if (distance_[k] < distance_[best]) best = k;
    }
    if (!std::isfinite(distance_[best])) return std::nullopt;
    const double finer = parabola_vertex(distance_[(best + sectors - 1) % sectors], distance_[best],
                                         distance_[(best + 1) % sectors]);
    const double yaw = 2.0 * std::numbers::pi * (double(best) + finer) / double(sectors);
    return Match{r, 0, distance_[best], std::remainder(yaw, 2.0 * std::numbers::pi)};
  }

 private:
  int columns_in_common(std::size_t shift, std::size_t r) const {
    if (query_is_full_) return reference_.filled_count(r);  // most scans: no counting needed
    return overlap_.count(int(shift), reference_.filled(r));
  }

  const Spectra& reference_;
  Overlap overlap_;
  bool query_is_full_;
  double least_columns_;
  std::vector<double> distance_;  // of every shift
};

bool any_allowed(const cambium::Pairing& pairing, Block queries, Block references) {
  for (std::size_t q = queries.begin; q < queries.end; ++q)
    for (std::size_t r = references.begin; r < references.end; ++r)
      if (pairing.allowed(q, r)) return true;
  return false;
}

/// Sorts best first and keeps the best view of a reference, and `count` references.
void keep_best(std::vector<Match>& matches, std::size_t count) {
  const auto order = [](const Match& m) { return std::tuple(m.distance, m.reference, m.view); };
  std::sort(matches.begin(), matches.end(),
            [&](const Match& a, const Match& b) { return order(a) < order(b); });
  std::vector<Match> kept;
  for (const Match& m : matches) {
    if (kept.size() == count) break;
    const auto same = [&](const Match& k) { return k.reference == m.reference; };
    if (std::none_of(kept.begin(), kept.end(), same)) kept.push_back(m);
  }
  matches = std::move(kept);
}

/// The matches of a few queries.
class BlockSearch {
 public:
  BlockSearch(Block queries, const Spectra& reference, const cambium::Pairing& pairing,
              const Limits& limits, const cambium::Context& context)
      : queries_(queries),
        reference_(reference),
        pairing_(pairing),
        limits_(limits),
        context_(context) {}

  /// Adds the matches of the queries as seen from one viewpoint to `matches` (one row a query).
  void add(const Spectra& query, std::size_t view, std::span<std::vector<Match>> matches) const {
    const Correlator correlator(query, reference_);
    std::vector<PairScorer> scorers;
    for (std::size_t q = queries_.begin; q < queries_.end; ++q)
      scorers.emplace_back(query, reference_, q, limits_);
    for (std::size_t first = 0; first < reference_.size(); first += reference_block) {
      const Block references{first, std::min(first + reference_block, reference_.size())};
      context_.check_cancelled();
      if (!any_allowed(pairing_, queries_, references)) continue;
      const Eigen::MatrixXf sums = correlator.correlate(queries_, references);
      for (Eigen::Index pair = 0; pair < sums.cols(); ++pair) {
        const std::size_t row = std::size_t(pair) / references.size();
        const std::size_t r = first + std::size_t(pair) % references.size();
        if (!pairing_.allowed(queries_.begin + row, r)) continue;
        auto match = scorers[row].score(sums.col(pair).data(), r);
        if (!match || match->distance > limits_.threshold) continue;
        match->view = view;
        matches[row].push_back(*match);
      }
    }
  }

 private:
  Block queries_;
  const Spectra& reference_;
  const cambium::Pairing& pairing_;
  const Limits& limits_;
  const cambium::Context& context_;
};

}  // namespace

std::vector<std::vector<Match>> search(const std::vector<Spectra>& views, const Spectra& reference,
                                       const cambium::Pairing& pairing, const Limits& limits,
                                       const cambium::Context& context) {
  const std::size_t count = views.front().size();
  std::vector<std::vector<Match>> matches(count);
  context.parallel_for((count + query_block - 1) / query_block, [&](std::size_t block) {
    const Block queries{block * query_block, std::min((block + 1) * query_block, count)};
    const std::span own(matches.data() + queries.begin, queries.size());
    const BlockSearch search(queries, reference, pairing, limits, context);
    for (std::size_t v = 0; v < views.size(); ++v) search.add(views[v], v, own);
    for (auto& of_query : own) keep_best(of_query, std::size_t(limits.candidates));
  });
  return matches;
}

}  // namespace scan_context
