// SPDX-License-Identifier: BSD-3-Clause
#include "vocabulary.hpp"

#include <algorithm>
#include <random>

namespace visual_bow {
namespace {

using columns::Bits;
using Group = std::vector<Bits>;

constexpr int most_rounds = 10;  // of k-medians; it moves little after five

/// Every bit as the majority has it: the sum of Hamming distances is least there.
Bits median_of(const Group& group) {
  Bits out{};
  for (std::size_t w = 0; w < out.size(); ++w)
    for (int bit = 0; bit < 64; ++bit) {
      std::size_t set = 0;
      for (const Bits& d : group) set += d[w] >> bit & 1;
      if (2 * set > group.size()) out[w] |= std::uint64_t(1) << bit;
    }
  return out;
}

/// Different descriptors of the group, at most `count`, each far from those before (the idea of
/// k-means++: the farther, the more probable).
std::vector<Bits> first_medians(const Group& group, std::size_t count, std::mt19937_64& random) {
  std::vector<Bits> out{group[random() % group.size()]};
  std::vector<std::uint64_t> reach(group.size());
  auto nearest = columns::nearest_bits(group, out).first;
  while (out.size() < count) {
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < group.size(); ++i) {
      sum += std::uint64_t(nearest[i].distance) * std::uint64_t(nearest[i].distance);
      reach[i] = sum;
    }
    if (sum == 0) break;  // all others are copies
    const auto drawn = std::ranges::upper_bound(reach, random() % sum);
    out.push_back(group[std::size_t(drawn - reach.begin())]);
    const auto to_new = columns::nearest_bits(group, std::span(out).last(1)).first;
    for (std::size_t i = 0; i < group.size(); ++i)
      nearest[i].distance = std::min(nearest[i].distance, to_new[i].distance);
  }
  return out;
}

/// k-medians: the medians, and what is nearest to each. Empty groups are dropped.
std::vector<std::pair<Bits, Group>> split(const Group& group, std::size_t count,
                                          std::mt19937_64& random,
                                          const cambium::Context& context) {
  std::vector<Bits> medians = first_medians(group, count, random);
  std::vector<Group> parts;
  for (int round = 0; round < most_rounds; ++round) {
    context.check_cancelled();
    parts.assign(medians.size(), {});
    const auto nearest = columns::nearest_bits(group, medians).first;
    for (std::size_t i = 0; i < group.size(); ++i) parts[nearest[i].index].push_back(group[i]);
    std::vector<Bits> moved = medians;
    for (std::size_t k = 0; k < parts.size(); ++k)
      if (!parts[k].empty()) moved[k] = median_of(parts[k]);
    if (moved == medians) break;
    medians = std::move(moved);
  }
  std::vector<std::pair<Bits, Group>> out;
  for (std::size_t k = 0; k < parts.size(); ++k)
    if (!parts[k].empty()) out.emplace_back(medians[k], std::move(parts[k]));
  return out;
}

}  // namespace

Vocabulary Vocabulary::grow(std::vector<Bits> descriptors, const VocabularyOptions& options,
                            std::uint64_t seed, const cambium::Context& context) {
  Vocabulary out;
  if (descriptors.empty()) return out;
  std::mt19937_64 random(seed);
  out.nodes_.push_back({});
  out.medians_.push_back({});
  std::vector<std::pair<std::size_t, Group>> level;  // node, its descriptors
  level.emplace_back(0, std::move(descriptors));
  for (int depth = 0; depth < options.depth; ++depth) {
    std::vector<std::pair<std::size_t, Group>> below;
    for (auto& [node, group] : level) {
      if (group.size() <= std::size_t(options.branching)) continue;  // stays a word
      auto parts = split(group, std::size_t(options.branching), random, context);
      if (parts.size() < 2) continue;
      out.nodes_[node].first_child = std::uint32_t(out.nodes_.size());
      out.nodes_[node].children = std::uint32_t(parts.size());
      for (auto& [median, part] : parts) {
        below.emplace_back(out.nodes_.size(), std::move(part));
        out.nodes_.push_back({});
        out.medians_.push_back(median);
      }
    }
    level = std::move(below);
  }
  return out;
}

std::size_t Vocabulary::word(const Bits& descriptor) const {
  std::size_t at = 0;
  while (nodes_[at].children > 0) {
    const auto children = std::span(medians_).subspan(nodes_[at].first_child, nodes_[at].children);
    at = nodes_[at].first_child + columns::nearest_bits({&descriptor, 1}, children).first[0].index;
  }
  return at;
}

std::size_t Vocabulary::words() const {
  return std::size_t(std::ranges::count(nodes_, 0u, &Node::children));
}

}  // namespace visual_bow
