// SPDX-License-Identifier: BSD-3-Clause
// Pictures as weighted words, and who shares which (Sivic, Zisserman, ICCV 2003).
#pragma once

#include "vocabulary.hpp"

namespace visual_bow {

/// Ascending words, each with its weight; the weights add up to 1. Empty: nothing is known.
using Bag = std::vector<std::pair<std::size_t, double>>;

class Index {
 public:
  /// One list of words a picture. The weight of a word is the file's, or with a grown vocabulary
  /// log((1 + n) / n_word) for n pictures, n_word of which have it.
  Index(const Vocabulary& vocabulary, bool weights_of_file,
        const std::vector<std::vector<std::size_t>>& pictures);

  /// Frequency of each word times its weight, as shares.
  Bag bag(const std::vector<std::size_t>& words) const;

  /// How much each picture has in common with a bag: the sum of the smaller shares, 0..1. That is 1
  /// less half of the L1 distance of the two.
  std::vector<double> similar(const Bag& bag) const;

 private:
  std::vector<double> weights_;                                        ///< of words
  std::vector<std::vector<std::pair<std::size_t, double>>> pictures_;  ///< of words: who has it
  std::size_t count_;
};

}  // namespace visual_bow
