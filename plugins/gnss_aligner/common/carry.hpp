// SPDX-License-Identifier: BSD-3-Clause
// Georeferences that missions bring along (GNSS_LLA_REF and GNSS_LLA_TO_MAP), carried into the map.
#pragma once
#include "cambium/kinds.hpp"

namespace cambium::gnss {

/// `refused`, with the mean of the georeferences of the island's missions when any has one.
/// Scores: how many there were and how far they disagree.
GnssAlignment or_carried(const GnssAlignment& refused, const Atlas& atlas, const Island& island);

}  // namespace cambium::gnss
