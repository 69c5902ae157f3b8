// SPDX-License-Identifier: BSD-3-Clause
// How well two scans agree under one relative pose.
#pragma once
#include "surface.hpp"

namespace map_crispness {

/// NaN where nothing could be compared.
struct Agreement {
  double all, ground, upright;  ///< median point-to-plane distance [m]
  double entropy;               ///< mean over the points [nat]
  double overlap = 0;           ///< share of the source's points with a surface of the target
};

struct Reach {
  double contact = 0;  ///< a point looks so far for a surface [m]
  double entropy = 0;  ///< radius of the neighbourhoods whose entropy is taken [m]
};

/// `points` are some points of the source scan; the entropy also looks at their neighbours in it.
Agreement agreement(Surface& target, Surface& source, const cambium::Cloud& points,
                    const cambium::SE3& T_target_source, const Reach& reach);

}  // namespace map_crispness
