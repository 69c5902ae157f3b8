// SPDX-License-Identifier: BSD-3-Clause
// What a fix is worth when the receiver gives no covariance.
#pragma once
#include "cambium/mission.hpp"

namespace cambium {

/// East, north, up [m^2], from the quality of a GGA sentence (1 single, 2 differential, 3 PPS, 4
/// RTK, 5 float RTK, 6 dead reckoning) and the horizontal dilution of precision; height counts
/// double. The sigmas are those under open sky: a canopy makes them several times larger, which
/// aligners find out from the residuals.
Mat3 covariance_of_quality(int quality, double hdop = 1);

/// Whether a quality tells of a measured place: 0 is no fix, 7 typed in, 8 simulated.
inline bool measured(int quality) { return quality >= 1 && quality <= 6; }

}  // namespace cambium
