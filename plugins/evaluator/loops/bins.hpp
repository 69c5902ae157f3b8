// SPDX-License-Identifier: BSD-3-Clause
// Bins of true distance, and how many pairs of nodes lie in each.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "cambium/context.hpp"
#include "cambium/truth.hpp"

namespace loops {

class Bins {
 public:
  explicit Bins(std::vector<double> edges) : edges_(std::move(edges)) {}  ///< [m], ascending

  std::size_t size() const { return edges_.size() - 1; }
  std::optional<std::size_t> of(double distance) const;  ///< low edge <= distance < high edge
  std::string name(std::size_t bin) const;               ///< "0-2"
  double low() const { return edges_.front(); }
  double high() const { return edges_.back(); }

 private:
  std::vector<double> edges_;
};

/// Pairs of nodes of two missions that are truly so far apart, per bin.
std::vector<std::size_t> close_pairs(const cambium::Truth& truth, const Bins& bins,
                                     const cambium::Context& context);

}  // namespace loops
