// SPDX-License-Identifier: BSD-3-Clause
// Real scans with true poses, for bench_registrations.
#pragma once
#include <string>
#include <vector>

#include "cambium/plugin.hpp"

namespace cambium::bench {

struct Scan {
  Payload payload;
  SE3 T_world_base;  ///< ground truth, or the best there is
};

/// A mission of "missions_newer_college". Empty when the data is not there.
std::vector<Scan> newer_college(const std::string& mission);
/// The 21 scans of a sequence of "scans_mulran" (KAIST03, Seosan01).
std::vector<Scan> mulran(const std::string& sequence);
/// "missions_nclt"; the poses are chained registrations, good over short distances only.
std::vector<Scan> nclt();

}  // namespace cambium::bench
