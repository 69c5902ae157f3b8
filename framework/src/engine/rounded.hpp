// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "cambium/se3.hpp"

namespace cambium {

/// The transform on a grid of 0.2 m and 0.02 rad. A first guess that comes from the map is taken
/// from there: when missions are added, the map moves by centimetres, and what was registered from
/// nearly the same guess is still in the cache. Registrations converge from much farther away.
SE3 rounded(const SE3& T);

}  // namespace cambium
