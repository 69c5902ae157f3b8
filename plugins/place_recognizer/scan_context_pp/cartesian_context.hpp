// SPDX-License-Identifier: BSD-3-Clause
// The augmented cartesian context: a passage along the reference's heading or against it, lanes
// apart. Queries are also described as reversed, turned a little, and from some bins ahead and
// behind.
#pragma once
#include "cartesian.hpp"
#include "common/search.hpp"
#include "placement.hpp"

namespace scan_context_pp {

class CartesianContext {
 public:
  void params(cambium::ParamVisitor& v);
  std::string check_params() const;

  /// Of a node: the descriptor of the base, then for each heading the heights that views are made
  /// of.
  std::size_t floats() const {
    return grid_.shape().bins() + grid_.all_headings().size() * grid_.height_count();
  }
  std::size_t bytes(std::size_t nodes) const { return columns::tile_bytes(nodes, grid_.shape()); }
  void describe(const cambium::Cloud::Matrix3X& levelled, double height_offset,
                std::span<float> numbers) const;
  void encode(cambium::Fingerprints& fingerprints, Place at, const cambium::Context& context) const;
  /// One list a query. `limits.threshold` is replaced by that of this context.
  std::vector<Placements> match(const Missions& missions, Place query, Place reference,
                                columns::Limits limits, const cambium::Context& context) const;

 private:
  cambium::Fingerprints all_views(const cambium::Fingerprints& query, Place at) const;

  CartesianGrid grid_;
  double threshold_ = 0.6;
};

}  // namespace scan_context_pp
