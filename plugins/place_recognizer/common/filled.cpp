// SPDX-License-Identifier: BSD-3-Clause
#include "common/filled.hpp"

#include <algorithm>
#include <bit>

namespace columns {

std::vector<std::uint64_t> filled_columns(std::span<const float> descriptor, Shape shape) {
  std::vector<std::uint64_t> words(shape.words(), 0);
  const auto rings = std::size_t(shape.rings);
  for (std::size_t s = 0; s < std::size_t(shape.sectors); ++s) {
    const auto column = descriptor.subspan(s * rings, rings);
    if (std::any_of(column.begin(), column.end(), [](float x) { return x != 0.0f; }))
      words[s / 64] |= std::uint64_t(1) << (s % 64);
  }
  return words;
}

int count_bits(std::span<const std::uint64_t> words) {
  int n = 0;
  for (const std::uint64_t word : words) n += std::popcount(word);
  return n;
}

Overlap::Overlap(std::span<const std::uint64_t> query, Shape shape)
    : words_(shape.words()), shifted_(std::size_t(shape.sectors) * words_, 0) {
  const auto sectors = std::size_t(shape.sectors);
  for (std::size_t s = 0; s < sectors; ++s) {
    if (!(query[s / 64] >> (s % 64) & 1)) continue;
    for (std::size_t k = 0; k < sectors; ++k) {
      const std::size_t to = (s + k) % sectors;
      shifted_[k * words_ + to / 64] |= std::uint64_t(1) << (to % 64);
    }
  }
}

int Overlap::count(std::size_t shift, std::span<const std::uint64_t> reference) const {
  int n = 0;
  for (std::size_t w = 0; w < words_; ++w)
    n += std::popcount(shifted_[shift * words_ + w] & reference[w]);
  return n;
}

}  // namespace columns
