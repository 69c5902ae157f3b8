// SPDX-License-Identifier: BSD-3-Clause
// Simulated folders, read back.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "cambium/files.hpp"
#include "cambium/truth.hpp"
#include "simulate/simulate.hpp"
#include "support/support.hpp"

namespace cambium::simulate {

/// Simulates tests/specs/<name>.yaml into a temporary folder.
class Simulated {
 public:
  explicit Simulated(const std::string& name, int threads = 2);
  std::filesystem::path path(const std::string& file) const { return folder_ / file; }
  Mission mission(const std::string& name) const;                    ///< through the real reader
  std::vector<StampedPose> truth(const std::string& mission) const;  ///< one per node
  /// The table in a CSV file, by the words of its header.
  std::vector<std::map<std::string, std::string>> table(const std::string& file) const;

  SimulationSpec spec;
  Summary summary;

 private:
  testing::TemporaryFolder folder_;
};

/// Relative path and content of every file below a folder.
std::map<std::string, std::string> contents(const std::filesystem::path& folder);

}  // namespace cambium::simulate
