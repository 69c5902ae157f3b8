// SPDX-License-Identifier: BSD-3-Clause
// Georeferences that missions bring along (GNSS_LLA_REF and GNSS_LLA_TO_MAP), carried into the map.
#pragma once
#include "cambium/kinds.hpp"

namespace similarity_4dof {

/// The mean of the georeferences of the island's missions, or nothing when none has one.
/// Scores: how many there were and how far they disagree.
cambium::GnssAlignment carry(const cambium::Atlas& atlas, const cambium::Island& island);

}  // namespace similarity_4dof
