// SPDX-License-Identifier: BSD-3-Clause
// Which columns are filled, and how many are filled in both descriptors of a pair.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "common/shape.hpp"

namespace columns {

/// One bit a sector, in shape.words() words: the column has a number other than 0.
std::vector<std::uint64_t> filled_columns(std::span<const float> descriptor, Shape shape);

int count_bits(std::span<const std::uint64_t> words);

/// n(k) of one query against any reference.
class Overlap {
 public:
  Overlap(std::span<const std::uint64_t> query, Shape shape);
  /// [sectors][words]: the query's mask at every shift.
  const std::uint64_t* shifted() const { return shifted_.data(); }
  int count(std::size_t shift, std::span<const std::uint64_t> reference) const;

 private:
  std::size_t words_;
  std::vector<std::uint64_t> shifted_;
};

}  // namespace columns
