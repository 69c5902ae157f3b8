// SPDX-License-Identifier: BSD-3-Clause
#include "hypotheses.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace canopy_match {
namespace {

using cambium::SE3;
using cambium::Vec3;

constexpr double max_bins = 4e6;  // of one heading

struct Peak {
  double votes = 0, yaw = 0, x = 0, y = 0;
  bool operator<(const Peak& o) const {
    return votes != o.votes ? votes > o.votes : std::tie(yaw, x, y) < std::tie(o.yaw, o.x, o.y);
  }
};

struct Extent {
  Vec3 centre = Vec3::Zero();
  double reach = 0;
};

Extent extent(std::span<const Vec3> trees) {
  Extent out;
  for (const Vec3& p : trees) out.centre += p / double(trees.size());
  for (const Vec3& p : trees) out.reach = std::max(out.reach, (p - out.centre).head<2>().norm());
  return out;
}

class Votes {
 public:
  Votes(double reach, double bin) : bin_(bin), half_(int(std::ceil(reach / bin)) + 1) {
    counts_.assign(std::size_t(side()) * std::size_t(side()), 0);
  }
  int side() const { return 2 * half_ + 1; }

  /// The fullest squares of three by three bins around a bin; each bin's own votes first.
  void peaks(double yaw, std::size_t count, std::vector<Peak>& out) {
    std::vector<Peak> found;
    double least = 0;
    for (int r = 1; r + 1 < side(); ++r)
      for (int c = 1; c + 1 < side(); ++c) {
        if (at(c, r) == 0) continue;
        double votes = 0;
        for (int dr = -1; dr <= 1; ++dr)
          for (int dc = -1; dc <= 1; ++dc)
            votes += at(c + dc, r + dr) * (dr == 0 && dc == 0 ? 1 : 0.5);
        if (votes <= least) continue;
        found.push_back({votes, yaw, (c - half_) * bin_, (r - half_) * bin_});
        if (found.size() < 4 * count) continue;
        std::nth_element(found.begin(), found.begin() + std::ptrdiff_t(count), found.end());
        found.resize(count);
        least = found.back().votes;
        for (const Peak& p : found) least = std::min(least, p.votes);
      }
    out.insert(out.end(), found.begin(), found.end());
  }
  void vote(double x, double y) {
    ++counts_[std::size_t(std::lround(y / bin_) + half_) * std::size_t(side()) +
              std::size_t(std::lround(x / bin_) + half_)];
  }

 private:
  double at(int c, int r) const {
    return counts_[std::size_t(r) * std::size_t(side()) + std::size_t(c)];
  }
  double bin_;
  int half_;
  std::vector<std::uint16_t> counts_;
};

/// Of peaks near each other the fullest.
std::vector<Peak> distinct(std::vector<Peak> peaks, double bin, double yaw_step,
                           std::size_t count) {
  std::sort(peaks.begin(), peaks.end());
  std::vector<Peak> out;
  for (const Peak& p : peaks) {
    const bool known = std::ranges::any_of(out, [&](const Peak& o) {
      return std::hypot(p.x - o.x, p.y - o.y) < 2.5 * bin &&
             std::abs(std::remainder(p.yaw - o.yaw, 2 * std::numbers::pi)) < 2.5 * yaw_step;
    });
    if (!known) out.push_back(p);
    if (out.size() == count) break;
  }
  return out;
}

}  // namespace

std::vector<SE3> hypotheses(std::span<const Vec3> reference, std::span<const Vec3> query,
                            double bin, std::size_t count, const cambium::Context& context) {
  if (reference.size() < 3 || query.size() < 3) return {};
  const Extent to = extent(reference), from = extent(query);
  // Large maps are searched with bins that memory can hold.
  while (std::pow(2 * (to.reach + from.reach) / bin + 3, 2) > max_bins) bin *= 2;
  const auto headings =
      std::size_t(std::ceil(2 * std::numbers::pi * std::max(from.reach, bin) / bin));
  const double step = 2 * std::numbers::pi / double(headings);
  std::vector<std::vector<Peak>> found(headings);
  context.parallel_for(headings, [&](std::size_t k) {
    context.check_cancelled();
    Votes votes(to.reach + from.reach, bin);
    const SE3 turn = SE3::from_yaw(double(k) * step);
    for (const Vec3& q : query) {
      const Vec3 turned = turn * Vec3(q - from.centre);
      for (const Vec3& r : reference)
        votes.vote(r.x() - to.centre.x() - turned.x(), r.y() - to.centre.y() - turned.y());
    }
    votes.peaks(double(k) * step, count, found[k]);
  });
  std::vector<Peak> all;
  for (const auto& f : found) all.insert(all.end(), f.begin(), f.end());
  std::vector<SE3> out;
  for (const Peak& p : distinct(std::move(all), bin, step, count)) {
    SE3 T = SE3::from_yaw(p.yaw);
    T.t = to.centre + Vec3(p.x, p.y, 0) - T.q * from.centre;
    out.push_back(T);
  }
  return out;
}

}  // namespace canopy_match
