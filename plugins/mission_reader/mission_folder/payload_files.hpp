// SPDX-License-Identifier: BSD-3-Clause
// Which files of a mission folder belong to which stamp.
#pragma once
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "cambium/mission.hpp"

namespace cambium {

struct StampedFiles {
  std::filesystem::path folder;  ///< empty: there is none
  std::map<Stamp, std::filesystem::path> by_stamp;
  std::vector<std::string> unnamed;  ///< files whose name has no stamp, sorted
};

/// Files <prefix>_<sec>_<nsec>.<one of extensions> of a folder. An earlier extension wins; that
/// another one was there goes to `warnings`. Throws Error(data) when the folder cannot be read.
StampedFiles find_stamped_files(const std::filesystem::path& folder, const std::string& prefix,
                                const std::vector<std::string>& extensions,
                                std::vector<std::string>& warnings);

/// Says which nodes have no file and which files no node.
void report_mismatch(const Mission& mission, const StampedFiles& files, const std::string& what,
                     std::vector<std::string>& warnings);

/// Stamps that several nodes carry, as a clock that stood still leaves them: which of them saw what
/// lies in their file is not known. Says so in `warnings`.
std::set<Stamp> shared_stamps(const Mission& mission, std::vector<std::string>& warnings);

/// "3 of 25 nodes have no cloud: a, b, c, ..."
std::string with_first_names(const std::string& what, const std::vector<std::string>& names);

}  // namespace cambium
