// SPDX-License-Identifier: BSD-3-Clause
// gnss.csv: sec,nsec,lat,lon,alt and one of sd_e,sd_n,sd_u, or
// cov_ee,cov_en,cov_eu,cov_nn,cov_nu,cov_uu, or quality (that of a GGA sentence).
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "cambium/mission.hpp"

namespace cambium {

/// In order of time. Adds to `warnings`. Throws Error(data, file:line).
std::vector<GnssFix> load_fixes(const std::filesystem::path& path,
                                std::vector<std::string>& warnings);

}  // namespace cambium
