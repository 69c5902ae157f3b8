// SPDX-License-Identifier: BSD-3-Clause
#include "voting.hpp"

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
  std::uint32_t slot;     ///< of its bin
};

/// Counts votes by bin: open addressing, so that counting touches little memory.
class Bins {
 public:
  Bins() : slots_(1 << 12, no_slot) {}

  std::uint32_t count(std::uint64_t key) {
    if (2 * keys_.size() >= slots_.size()) grow();
    std::uint32_t& slot = slots_[place(key)];
    if (slot == no_slot) {
      slot = std::uint32_t(keys_.size());
      keys_.push_back(key);
      counts_.push_back(0);
    }
    ++counts_[slot];
    return slot;
  }

  /// The fullest first; of two equally full ones, the lower key.
  std::vector<std::uint32_t> fullest(std::size_t count) const {
    std::vector<std::uint32_t> order(keys_.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = std::uint32_t(i);
    count = std::min(count, order.size());
    std::partial_sort(order.begin(), order.begin() + std::ptrdiff_t(count), order.end(),
                      [&](std::uint32_t a, std::uint32_t b) {
                        return counts_[a] != counts_[b] ? counts_[a] > counts_[b]
                                                        : keys_[a] < keys_[b];
                      });
    order.resize(count);
    return order;
  }
  std::size_t size() const { return keys_.size(); }

 private:
  static constexpr std::uint32_t no_slot = ~std::uint32_t(0);

  std::size_t place(std::uint64_t key) const {
    std::size_t at = std::size_t((key * 0x9E3779B97F4A7C15u) >> 32) & (slots_.size() - 1);
    while (slots_[at] != no_slot && keys_[slots_[at]] != key) at = (at + 1) & (slots_.size() - 1);
    return at;
  }
  void grow() {
    slots_.assign(2 * slots_.size(), no_slot);
    for (std::size_t i = 0; i < keys_.size(); ++i) slots_[place(keys_[i])] = std::uint32_t(i);
  }

  std::vector<std::uint32_t> slots_;
  std::vector<std::uint64_t> keys_;
  std::vector<std::uint32_t> counts_;
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
                       std::uint32_t end, const VoteLimits& limits, Bins& bins) {
  static const Circle circle;
  const auto sectors = std::uint32_t(std::max(1.0, std::round(turn / limits.bin_yaw)));
  std::vector<Vote> votes;
  for (const Triangle& q : query)
    reference.hits(q, end, [&](const Triangle& r) {
      const auto heading = std::uint16_t(r.heading - q.heading);
      const auto [c, s] = circle[heading];
      const float x = r.x - c * q.x + s * q.y, y = r.y - s * q.x - c * q.y;
      votes.push_back({x, y, heading, bins.count(bin_of(x, y, heading, limits, sectors))});
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
  Bins bins;
  const std::vector<Vote> votes = cast(query, reference, end, limits, bins);
  const auto fullest = bins.fullest(std::size_t(limits.bins));
  std::vector<std::uint8_t> rank(bins.size(), 255);
  std::vector<Sum> sums(fullest.size());
  for (std::size_t i = 0; i < fullest.size(); ++i) rank[fullest[i]] = std::uint8_t(i);
  for (const Vote& v : votes)
    if (rank[v.slot] != 255) sums[rank[v.slot]].add(v);
  std::vector<Peak> peaks;
  for (const Sum& sum : sums) peaks.push_back(sum.mean());
  return peaks;
}

}  // namespace tree_match
