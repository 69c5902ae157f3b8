// SPDX-License-Identifier: BSD-3-Clause
// The cloud of one node, thinned: what the page shows of the two ends of a loop.
#pragma once
#include <string>

#include "cambium/payload.hpp"

namespace web_view {

/// About `most` points of a cloud, evenly out of all, in the base frame of its node: x, y, z in whole
/// centimetres (16 bits each, little endian). Points farther than 327 m are left out.
std::string pair_cloud(const cambium::Cloud& cloud, std::size_t most);

}  // namespace web_view
