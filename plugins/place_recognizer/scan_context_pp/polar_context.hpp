// SPDX-License-Identifier: BSD-3-Clause
// The augmented polar context: queries are also described from virtual viewpoints on both sides, so
// that a passage some metres beside is found at any heading.
#pragma once
#include "common/polar.hpp"
#include "common/search.hpp"
#include "placement.hpp"

namespace scan_context_pp {

class PolarContext {
 public:
  void params(cambium::ParamVisitor& v);

  std::size_t floats() const { return views().size() * grid_.shape.bins(); }
  std::size_t bytes(std::size_t nodes) const { return columns::tile_bytes(nodes, grid_.shape); }
  void describe(const cambium::Cloud::Matrix3X& levelled, double height_offset,
                std::span<float> numbers) const;
  void encode(cambium::Fingerprints& fingerprints, Place at, const cambium::Context& context) const;
  /// One list a query. `limits.threshold` is replaced by that of this context.
  std::vector<Placements> match(const Missions& missions, Place query, Place reference,
                                columns::Limits limits, const cambium::Context& context) const;

 private:
  std::vector<Eigen::Vector2f> views() const;

  columns::PolarGrid grid_;
  int lateral_views_ = 1;
  double lateral_step_ = 2.0;
  double threshold_ = 0.4;
};

}  // namespace scan_context_pp
