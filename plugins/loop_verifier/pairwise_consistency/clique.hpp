// SPDX-License-Identifier: BSD-3-Clause
// The largest set of vertices that are all neighbours of each other.
#pragma once
#include <cstdint>
#include <functional>
#include <vector>

namespace cambium::pcm {

/// A set of small integers.
class Bits {
 public:
  explicit Bits(std::size_t size) : words_((size + 63) / 64) {}
  void set(std::size_t i) { words_[i / 64] |= std::uint64_t{1} << (i % 64); }
  void reset(std::size_t i) { words_[i / 64] &= ~(std::uint64_t{1} << (i % 64)); }
  bool test(std::size_t i) const { return words_[i / 64] >> (i % 64) & 1; }
  Bits& operator&=(const Bits& other);
  Bits& remove(const Bits& other);
  std::size_t first() const;  ///< the smallest member; npos when empty
  std::size_t count() const;
  static constexpr std::size_t npos = ~std::size_t{0};

 private:
  std::vector<std::uint64_t> words_;
};

struct CliqueProblem {
  std::vector<Bits> neighbours;  ///< symmetric, no vertex is its own neighbour
  std::function<double(std::size_t, std::size_t)> distance;  ///< >= 0, between neighbours
  std::size_t branch_limit = 0;
  std::function<void()> check_cancelled;
};

struct Clique {
  std::vector<std::size_t> members;  ///< ascending
  bool exact = true;                 ///< false: the branch limit was reached, a larger may exist
};

/// Branch and bound with greedy colouring (E. Tomita, T. Seki, COCOON 2003; bit sets after P. San
/// Segundo et al., 2011) among `allowed`. Of several largest cliques it takes the one with the
/// smallest sum of distances, then the lexicographically first. At the branch limit the best so far
/// is taken: the search order is fixed, so this too is the same on every run.
Clique maximum_clique(const CliqueProblem& problem, const Bits& allowed);

}  // namespace cambium::pcm
