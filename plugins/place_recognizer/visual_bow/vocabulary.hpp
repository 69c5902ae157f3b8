// SPDX-License-Identifier: BSD-3-Clause
// Visual words: the leaves of a tree of medians (Nister, Stewenius, CVPR 2006; for binary
// descriptors Galvez-Lopez, Tardos, T-RO 2012).
#pragma once
#include <filesystem>
#include <vector>

#include "cambium/context.hpp"
#include "common/hamming.hpp"

namespace visual_bow {

struct VocabularyOptions {
  int branching = 10;  ///< children of a node
  int depth = 4;       ///< levels below the root: at most branching^depth words
};

class Vocabulary {
 public:
  struct Node {
    std::uint32_t first_child = 0, children = 0;  ///< no children: a word
    float weight = 0;                             ///< a word's, when a file gave it
  };

  /// Each node's descriptors are split by k-medians. `seed` draws the first medians; the same
  /// descriptors in the same order give the same tree. Throws Cancelled.
  static Vocabulary grow(std::vector<columns::Bits> descriptors, const VocabularyOptions& options,
                         std::uint64_t seed, const cambium::Context& context);

  /// The text format of DBoW2, as ORB-SLAM ships its vocabulary: "branching depth scoring
  /// weighting", then a line a node: parent, 1 for a word, 32 bytes, weight. Throws Error(data)
  /// with file and line.
  static Vocabulary read(const std::filesystem::path& file);

  Vocabulary() = default;
  Vocabulary(std::vector<Node> nodes, std::vector<columns::Bits> medians)
      : nodes_(std::move(nodes)), medians_(std::move(medians)) {}

  /// The word of a descriptor: an index below size(). There must be a node.
  std::size_t word(const columns::Bits& descriptor) const;
  std::size_t size() const { return nodes_.size(); }
  std::size_t words() const;
  double weight(std::size_t word) const { return double(nodes_[word].weight); }
  const std::vector<Node>& nodes() const { return nodes_; }
  const std::vector<columns::Bits>& medians() const { return medians_; }

 private:
  std::vector<Node> nodes_;             ///< the root first; children side by side
  std::vector<columns::Bits> medians_;  ///< one a node
};

}  // namespace visual_bow
