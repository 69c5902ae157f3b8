// SPDX-License-Identifier: BSD-3-Clause
// Where one map of trees may lie in another, without any guess.
#pragma once
#include <span>
#include <vector>

#include "cambium/context.hpp"
#include "cambium/se3.hpp"

namespace canopy_match {

/// For every heading each pair of a reference and a query tree votes for the position that would
/// lay one on the other (a generalised Hough transform: D. Ballard, 1981); votes are counted in
/// bins of `bin` [m], together with their neighbours. Returns the `count` fullest ones of different
/// places, most votes first. Headings are as fine as the bin at `reach` [m], the size of the query.
std::vector<cambium::SE3> hypotheses(std::span<const cambium::Vec3> reference,
                                     std::span<const cambium::Vec3> query, double bin,
                                     std::size_t count, const cambium::Context& context);

}  // namespace canopy_match
