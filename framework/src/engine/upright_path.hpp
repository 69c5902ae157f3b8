// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>

#include "cambium/mission.hpp"

namespace cambium {

/// How far from z [rad] the normal of the mission's path is, when the path lies in a plane that no
/// robot walks in: more than 60 degrees. A frame with z forward, as cameras have it, shows so even
/// where nothing ties the mission to another. Nothing for paths that are straight, or that use all
/// three dimensions.
std::optional<double> upright_path(const Mission& mission);

}  // namespace cambium
