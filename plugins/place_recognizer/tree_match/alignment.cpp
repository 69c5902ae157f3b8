// SPDX-License-Identifier: BSD-3-Clause
#include "alignment.hpp"

#include <numbers>

#include "cambium/fit.hpp"

namespace tree_match {
namespace {

using cambium::SE3;
using cambium::Vec3;

Planar refit(const std::vector<Match>& matches, std::span<const Stem> query,
             std::span<const Stem> reference) {
  std::vector<Vec3> target, source;
  for (const Match& m : matches) {
    target.emplace_back(reference[m.reference].x, reference[m.reference].y, 0);
    source.emplace_back(query[m.query].x, query[m.query].y, 0);
  }
  const SE3 T = cambium::fit_yaw(target, source);
  return {T.t.x(), T.t.y(), T.yaw()};
}

/// Moves the feet of stems.
struct Move {
  explicit Move(const Planar& T)
      : c(float(std::cos(T.yaw))), s(float(std::sin(T.yaw))), x(float(T.x)), y(float(T.y)) {}
  std::array<float, 2> operator()(const Stem& p) const {
    return {c * p.x - s * p.y + x, s * p.x + c * p.y + y};
  }
  float c, s, x, y;
};

bool alike(const Stem& a, const Stem& b, double max_dbh_difference) {
  return a.dbh == 0 || b.dbh == 0 || std::abs(a.dbh - b.dbh) <= max_dbh_difference;
}

constexpr std::size_t fewest_to_fit = 3;

}  // namespace

void Overlayer::match(std::span<const Stem> query, double radius, std::uint32_t end,
                      Overlay& overlay) {
  const Move move(overlay.T_reference_query);
  std::vector<Match> found;
  for (std::uint32_t q = 0; q < query.size(); ++q) {
    const Stem& stem = query[q];
    Match best{q, no_match, std::numeric_limits<float>::max()};
    const auto p = move(stem);
    grid_.within(p[0], p[1], float(radius), [&](std::uint32_t r, float squared) {
      if (squared < best.squared && reference_[r].last < end &&
          alike(stem, reference_[r], limits_.max_dbh_difference))
        best = {q, r, squared};
    });
    if (best.reference == no_match) continue;
    std::uint32_t& owner = owner_[best.reference];
    if (owner == no_match) {
      owner = std::uint32_t(found.size());
      found.push_back(best);
    } else if (best.squared < found[owner].squared) {
      found[owner] = best;
    }
  }
  for (const Match& m : found) owner_[m.reference] = no_match;
  std::sort(found.begin(), found.end(),
            [](const Match& a, const Match& b) { return a.query < b.query; });
  overlay.matches = std::move(found);
}

Overlay Overlayer::start(std::span<const Stem> query, const Planar& T_reference_query,
                         std::uint32_t end) {
  Overlay overlay{T_reference_query, {}, 0};
  refine(query, limits_.coarse_radius, end, overlay);
  return overlay;
}

void Overlayer::refine(std::span<const Stem> query, double radius, std::uint32_t end,
                       Overlay& overlay) {
  match(query, radius, end, overlay);
  if (overlay.matches.size() >= fewest_to_fit)
    overlay.T_reference_query = refit(overlay.matches, query, reference_);
}

void Overlayer::finish(std::span<const Stem> query, std::uint32_t end, Overlay& overlay) {
  for (int i = 0; i < 2; ++i) refine(query, limits_.radius, end, overlay);
  match(query, limits_.radius, end, overlay);
}

double Overlayer::evidence(std::span<const Stem> query, std::span<const float> density,
                           const Coverage& coverage, std::uint32_t end, std::uint32_t step,
                           const Overlay& overlay) const {
  const Move move(overlay.T_reference_query);
  const double variance = limits_.sigma * limits_.sigma, share = limits_.detection;
  const double missed = std::log(1 - share);
  double sum = 0;
  auto match = overlay.matches.begin();
  for (std::uint32_t q = 0; q < query.size(); q += step) {
    while (match != overlay.matches.end() && match->query < q) ++match;
    if (match != overlay.matches.end() && match->query == q) {
      const double here =
          std::exp(-0.5 * match->squared / variance) / (2 * std::numbers::pi * variance);
      sum += std::log(1 - share + share * here / density[match->reference]);
    } else if (const auto [x, y] = move(query[q]); coverage.before(x, y, end)) {
      sum += missed;
    }
  }
  return sum * step;
}

// A stem is in the map once for each stretch of path that saw it: only the first one counts.
std::vector<float> densities(std::span<const Stem> stems, const StemGrid& grid) {
  constexpr float around = 4.0f, same_stem = 0.6f;
  std::vector<char> again(stems.size(), 0);
  for (std::uint32_t i = 0; i < stems.size(); ++i)
    if (!again[i])
      grid.within(stems[i].x, stems[i].y, same_stem, [&](std::uint32_t k, float) {
        if (k > i) again[k] = 1;
      });
  std::vector<float> out;
  for (const Stem& s : stems) {
    int count = 0;
    grid.within(s.x, s.y, around, [&](std::uint32_t i, float) { count += !again[i]; });
    out.push_back(float(std::max(count, 1)) / (std::numbers::pi_v<float> * around * around));
  }
  return out;
}

}  // namespace tree_match
