// SPDX-License-Identifier: BSD-3-Clause
#include "voting.hpp"

#include <algorithm>
#include <numbers>

namespace tree_match {
namespace {

constexpr double turn = 2 * std::numbers::pi;

/// Sine and cosine of headings in steps of 0.35 degrees: an error of 5 cm at 15 m, far below a bin.
class Circle {
 public:
  Circle() {
    for (std::size_t i = 0; i < size; ++i) {
      const double angle = turn * (double(i) + 0.5) / double(size);
      cos_sin_[i] = {float(std::cos(angle)), float(std::sin(angle))};
    }
  }
  const std::array<float, 2>& operator[](std::uint16_t heading) const {
    return cos_sin_[heading >> shift];
  }

 private:
  static constexpr int shift = 6;
  static constexpr std::size_t size = 65536 >> shift;
  std::array<std::array<float, 2>, size> cos_sin_;
};

struct Vote {
  float x, y;
  std::uint16_t heading;  ///< 2 pi / 65536 a unit
  std::uint16_t slot;     ///< of its bin among the counters
};

/// Counts votes in few enough counters to stay in the cache. Bins may share one, so that these
/// counts only say where it is worth looking.
class Counters {
 public:
  Counters() : counts_(1 << 16, 0) {}

  std::uint16_t count(std::uint64_t bin) {
    const auto slot = std::uint16_t((bin * 0x9E3779B97F4A7C15u) >> 48);
    counts_[slot] = std::uint16_t(counts_[slot] + (counts_[slot] < 0xFFFF));
    return slot;
  }
  std::uint16_t at(std::uint16_t slot) const { return counts_[slot]; }

  /// The highest count that at least `slots` counters reach; 1 when that many were never used.
  std::uint16_t reached_by(std::size_t slots) const {
    std::vector<std::size_t> with(0x10000, 0);
    for (const std::uint16_t c : counts_) ++with[c];
    std::size_t sum = 0;
    for (std::size_t c = with.size() - 1; c > 1; --c)
      if ((sum += with[c]) >= slots) return std::uint16_t(c);
    return 1;
  }

 private:
  std::vector<std::uint16_t> counts_;
};

/// Bins of x and y of 24 bits each, of the heading 16 bits.
std::uint64_t bin_of(float x, float y, std::uint16_t heading, const VoteLimits& limits,
                     std::uint32_t sectors) {
  const auto cell = [&](float v) {
    return std::uint64_t(std::int64_t(std::floor(v / float(limits.bin))) + (1 << 23)) & 0xFFFFFF;
  };
  return cell(x) << 40 | cell(y) << 16 | (std::uint64_t(heading) * sectors >> 16);
}

std::vector<Vote> cast(const std::vector<Triangle>& query, const TriangleIndex& reference,
                       std::uint32_t end, const VoteLimits& limits, std::uint32_t sectors,
                       Counters& counters) {
  static const Circle circle;
  std::vector<Vote> votes;
  for (const Triangle& q : query)
    reference.hits(q, end, [&](const Triangle& r) {
      const auto heading = std::uint16_t(r.heading - q.heading);
      const auto [c, s] = circle[heading];
      const float x = r.x - c * q.x + s * q.y, y = r.y - s * q.x - c * q.y;
      votes.push_back({x, y, heading, counters.count(bin_of(x, y, heading, limits, sectors))});
    });
  return votes;
}

/// Headings are averaged as offsets from the first vote: a bin is narrow, but may lie across pi.
struct Sum {
  double x = 0, y = 0, turned = 0;
  std::uint16_t first = 0;
  std::size_t count = 0;
  void add(const Vote& v) {
    if (count++ == 0) first = v.heading;
    x += v.x;
    y += v.y;
    turned += std::int16_t(v.heading - first);
  }
  Peak mean() const {
    const double n = double(count);
    const double yaw = turn / 65536 * (first + turned / n);
    return {{x / n, y / n, std::remainder(yaw, turn)}, count};
  }
};

}  // namespace

std::vector<Peak> vote(const std::vector<Triangle>& query, const TriangleIndex& reference,
                       std::uint32_t end, const VoteLimits& limits) {
  const auto sectors = std::uint32_t(std::max(1.0, std::round(turn / limits.bin_yaw)));
  Counters counters;
  const std::vector<Vote> votes = cast(query, reference, end, limits, sectors, counters);
  // Twice as many counters as bins are wanted: some are full by chance.
  const std::uint16_t least = counters.reached_by(2 * std::size_t(limits.bins));
  std::vector<std::pair<std::uint64_t, std::uint32_t>> by_bin;
  for (std::uint32_t i = 0; i < votes.size(); ++i)
    if (const Vote& v = votes[i]; counters.at(v.slot) >= least)
      by_bin.emplace_back(bin_of(v.x, v.y, v.heading, limits, sectors), i);
  std::sort(by_bin.begin(), by_bin.end());
  std::vector<Peak> peaks;
  for (auto from = by_bin.begin(); from != by_bin.end();) {
    Sum sum;
    const std::uint64_t bin = from->first;
    for (; from != by_bin.end() && from->first == bin; ++from) sum.add(votes[from->second]);
    peaks.push_back(sum.mean());
  }
  std::stable_sort(peaks.begin(), peaks.end(),
                   [](const Peak& a, const Peak& b) { return a.votes > b.votes; });
  peaks.resize(std::min(peaks.size(), std::size_t(limits.bins)));
  return peaks;
}

}  // namespace tree_match
