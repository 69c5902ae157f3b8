// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>

#include "monitor/changes.hpp"

namespace cambium::monitor {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
constexpr double similar_range = 2;  // distances at which a detector fares alike [m]

/// Where a survey stood and what it detected, in the map of the first survey.
struct Looks {
  std::vector<NodeRef> nodes;
  std::vector<Vec3> positions;
  std::vector<Vec3> detections;  ///< usable ones of all nodes

  Looks(const Survey& survey, const SE3& T, bool only_reconstructed, const Context& context) {
    for (const std::uint32_t m : survey.missions)
      for (std::uint32_t n = 0; n < survey.trees.missions[m].mission->nodes.size(); ++n)
        nodes.push_back({m, n});
    std::vector<std::vector<Vec3>> found(nodes.size());
    context.parallel_for(nodes.size(), [&](std::size_t i) {
      context.check_cancelled();
      const auto trees = survey.trees.payload(nodes[i]).trees;
      if (!trees) return;
      for (const Tree& t : *trees)
        if ((t.reconstructed || !only_reconstructed) && t.base.allFinite())
          found[i].push_back(T * (survey.trees.T_map_node(nodes[i]) * t.base));
    });
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      positions.push_back(T * survey.trees.T_map_node(nodes[i]).t);
      detections.insert(detections.end(), found[i].begin(), found[i].end());
    }
  }

  double range(std::size_t i, const Vec3& p) const { return (positions[i] - p).head<2>().norm(); }

  std::size_t near(const Vec3& p, double radius) const {
    return std::size_t(std::count_if(detections.begin(), detections.end(), [&](const Vec3& q) {
      return (p - q).head<2>().norm() < radius;
    }));
  }
};

/// How often `other` should have detected a tree that `own` knows: at each of its nodes with the
/// share of own nodes at a like distance that did. A distance from which own never looked counts
/// nothing.
double expected_sightings(const Looks& own, const Stem& stem, const Vec3& at, const Looks& other) {
  struct Look {
    double range;
    bool seen;
  };
  std::vector<Look> looks;
  double farthest = 0;
  for (std::size_t i = 0; i < own.nodes.size(); ++i) {
    const bool seen = std::binary_search(stem.seen_by.begin(), stem.seen_by.end(), own.nodes[i]);
    looks.push_back({own.range(i, at), seen});
    if (seen) farthest = std::max(farthest, looks.back().range);
  }
  double sum = 0;
  for (std::size_t i = 0; i < other.nodes.size(); ++i) {
    const double range = other.range(i, at);
    if (range > farthest + similar_range) continue;
    std::size_t tried = 0, seen = 0;
    for (const Look& look : looks) {
      if (std::abs(look.range - range) > similar_range) continue;
      ++tried;
      seen += look.seen;
    }
    if (tried > 0) sum += double(seen) / double(tried);
  }
  return sum;
}

StemChange kept(const Stem& a, const Stem& b, const Vec3& at) {
  StemChange c;
  c.change = Change::kept;
  c.base = at;
  c.before = a;
  c.after = b;
  c.growth = b.dbh - a.dbh;
  c.growth_sigma = std::hypot(a.dbh_sigma, b.dbh_sigma);
  return c;
}

class Comparison {
 public:
  Comparison(const std::vector<Stem>& a, const std::vector<Stem>& b, const SE3& T,
             const ChangesOptions& options)
      : a_(a), b_(b), options_(options) {
    for (const Stem& s : a) at_a_.push_back(s.base);
    for (const Stem& s : b) at_b_.push_back(T * s.base);
  }

  std::vector<StemChange> run(const Looks& before, const Looks& after) {
    std::vector<char> paired_a(a_.size(), 0), paired_b(b_.size(), 0);
    double seen[2] = {0, 0}, should[2] = {0, 0};
    for (const auto& [i, j] : mutual_nearest(at_a_, at_b_, options_.match_radius)) {
      paired_a[i] = paired_b[j] = 1;
      out_.push_back(kept(a_[i], b_[j], at_a_[i]));
      seen[0] += double(b_[j].seen_by.size());
      should[0] += expected_sightings(before, a_[i], at_a_[i], after);
      seen[1] += double(a_[i].seen_by.size());
      should[1] += expected_sightings(after, b_[j], at_b_[j], before);
    }
    // One detector may be keener than the other: the trees that both know tell.
    const double keen_after = should[0] > 0 ? seen[0] / should[0] : 1;
    const double keen_before = should[1] > 0 ? seen[1] / should[1] : 1;
    for (std::size_t i = 0; i < a_.size(); ++i)
      if (!paired_a[i]) missing(a_[i], at_a_[i], before, after, keen_after, Change::gone);
    for (std::size_t j = 0; j < b_.size(); ++j)
      if (!paired_b[j]) missing(b_[j], at_b_[j], after, before, keen_before, Change::appeared);
    std::sort(out_.begin(), out_.end(), [](const StemChange& p, const StemChange& q) {
      return std::tie(p.base.x(), p.base.y()) < std::tie(q.base.x(), q.base.y());
    });
    return std::move(out_);
  }

 private:
  void missing(const Stem& stem, const Vec3& at, const Looks& own, const Looks& other, double keen,
               Change change) {
    StemChange c;
    c.base = at;
    c.growth = c.growth_sigma = unknown;
    (change == Change::gone ? c.before : c.after) = stem;
    c.expected = keen * expected_sightings(own, stem, at, other);
    c.near = other.near(at, options_.match_radius);
    if (c.expected < options_.min_expected)
      c.reason = "the other survey did not look closely enough";
    else if (5 * double(c.near) > c.expected)
      c.reason = "the other survey detected something there, too seldom for a tree";
    else if (change == Change::appeared && stem.dbh > options_.max_growth)
      c.change = Change::overlooked;
    else
      c.change = change;
    out_.push_back(c);
  }

  const std::vector<Stem>&a_, &b_;
  const ChangesOptions& options_;
  std::vector<Vec3> at_a_, at_b_;
  std::vector<StemChange> out_;
};

}  // namespace

std::vector<StemChange> compare_stems(const Survey& before, const Survey& after,
                                      const std::vector<Stem>& stems_before,
                                      const std::vector<Stem>& stems_after,
                                      const SE3& T_before_after, const ChangesOptions& options,
                                      const Context& context) {
  const Looks looks_before(before, {}, options.stems.only_reconstructed, context);
  const Looks looks_after(after, T_before_after, options.stems.only_reconstructed, context);
  return Comparison(stems_before, stems_after, T_before_after, options)
      .run(looks_before, looks_after);
}

}  // namespace cambium::monitor
