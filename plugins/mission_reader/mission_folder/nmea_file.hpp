// SPDX-License-Identifier: BSD-3-Clause
// gnss.nmea: what a receiver wrote to its serial line.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "cambium/mission.hpp"

namespace cambium {

/// Fixes from GGA sentences, in order of time; the date comes from RMC or ZDA, sigmas from GST
/// where it is, else from quality and dilution. Altitudes become ellipsoidal by the geoid
/// separation; a fix without it gets a vertical sigma of 60 m. Stamps are UTC since 1970. Sentences
/// whose checksum does not fit are left out, with a warning. Throws Error(data) when nothing gives
/// a date.
std::vector<GnssFix> load_nmea(const std::filesystem::path& path,
                               std::vector<std::string>& warnings);

}  // namespace cambium
