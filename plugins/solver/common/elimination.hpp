// SPDX-License-Identifier: BSD-3-Clause
// In which order the poses of a graph are eliminated, and what the Cholesky factor of a matrix with
// one row of b x b blocks a pose looks like. Both are found once, on the graph of poses, for the
// matrices of all steps: a matrix has b times as many rows and b^2 times as many entries.
#pragma once
#include <utility>
#include <vector>

#include "cambium/pose_graph.hpp"
#include "common/cholmod.hpp"

namespace cambium::pose_solver {

class Elimination {
 public:
  /// Of the poses that are not held, coupled by the relative factors k with use[k] (empty: by all).
  Elimination(const PoseGraph& graph, const std::vector<bool>& held,
              const std::vector<bool>& use = {});
  ~Elimination();
  Elimination(const Elimination&) = delete;
  Elimination& operator=(const Elimination&) = delete;

  int count() const { return count_; }  ///< poses that are not held
  /// The row of blocks of a node; -1: it is held.
  int place(std::size_t node) const { return place_[node]; }
  /// Whether a relative factor ties two poses that are not held.
  bool couples(const RelativeFactor& f) const {
    return place_[f.tail] >= 0 && place_[f.head] >= 0 && f.tail != f.head;
  }
  /// The blocks of a matrix with a block for each pose and each coupling, by place.
  const LowerPattern& pattern() const { return pattern_; }

  /// The symbolic factor for blocks of that size, in this order: no permutation. The caller frees
  /// it. Null when it is too large for CHOLMOD.
  cholmod_factor* symbolic_factor(int block, cholmod_common* common) const;

 private:
  using Couplings = std::vector<std::pair<int, int>>;
  void find_order(const Couplings& couplings);

  int count_ = 0;
  std::vector<int> place_;
  LowerPattern pattern_;
  mutable CholmodSettings settings_;
  cholmod_factor* factor_ = nullptr;  ///< for blocks of size 1
};

}  // namespace cambium::pose_solver
