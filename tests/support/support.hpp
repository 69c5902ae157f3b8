// SPDX-License-Identifier: BSD-3-Clause
// What every test may use.
#pragma once
#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "cambium/plugin.hpp"

namespace cambium::testing {

/// A quiet context with its own scratch folder. `threads` > 1 runs parallel_for in an arena.
std::unique_ptr<Context> make_context(int threads = 1, std::uint64_t seed = 1);

/// A component of a shipped plugin, opened by the real loader, with parameters bound from YAML:
/// component<PlaceRecognizer>("scan_context", "{rings: 10}").
std::shared_ptr<Component> component(Kind kind, const std::string& name, const std::string& yaml);
template <class T>
std::shared_ptr<const T> component(const std::string& name, const std::string& yaml = "{}") {
  return std::dynamic_pointer_cast<const T>(component(T::kind, name, yaml));
}

/// A folder that is removed at the end of its scope.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

/// A payload that is already in memory.
std::shared_ptr<const PayloadSource> in_memory(Payload payload);
std::shared_ptr<const PayloadSource> in_memory(Cloud cloud);

/// Nodes 0..n-1 at the given poses (T_mission_node), one second apart, odometry edges between them
/// with sigma 0.05 m and 0.01 rad, no payload.
Mission make_mission(const std::string& name, const std::vector<SE3>& poses);

/// The missions side by side, each in its own island, T_map_node = T_mission_node.
Atlas make_atlas(std::vector<Mission> missions);

/// A made-up forest seen from T_world_base: rolling ground and stems, `seed` names the forest. The
/// same forest from two poses gives overlapping clouds. Points in the base frame, up to 30 m away.
Cloud forest_scan(const SE3& T_world_base, std::uint64_t seed = 1, std::size_t points = 20000);

/// A folder of the shared real data, unpacked; empty when it is not there. Use with SKIP:
///   const auto data = real_data("missions_newer_college"); if (data.empty()) GTEST_SKIP() << ...;
std::filesystem::path real_data(const std::string& archive);

}  // namespace cambium::testing
