// SPDX-License-Identifier: BSD-3-Clause
// The files of a mission folder (docs/formats.md). Every file is whole or absent, but not on the
// disk yet: who lost them to a power cut makes them again.
#pragma once
#include <filesystem>
#include <string>

#include "engine/engine.hpp"

namespace cambium {

/// PREFIX_<sec>_<nsec>EXTENSION, as the files of a node are named.
std::string stamped(const char* prefix, const Stamp& stamp, const char* extension);

/// Binary PCD with what the cloud has of x, y, z, normals, intensity and label.
void write_cloud(const Cloud& cloud, const Stamp& stamp, const std::filesystem::path& folder);

void write_trees(const std::vector<Tree>& trees, const Stamp& stamp,
                 const std::filesystem::path& folder);

/// gnss.csv: sigmas where all fixes are independent on every axis, else covariances.
void write_fixes(const std::vector<GnssFix>& fixes, const std::filesystem::path& folder);

struct WrittenMission {
  std::size_t clouds = 0, points = 0, tree_tables = 0, pictures = 0;
  /// What a mission folder has no place for: pictures of a second camera, inertial measurements.
  std::size_t other_pictures = 0, inertial = 0;
  WrittenMission& operator+=(const WrittenMission& other);
};

/// Pose graph, fixes and payloads, into a folder that is there. One payload a thread is in memory.
/// Throws Error(data), also for a node that has a payload but no stamp to name it by.
WrittenMission write_mission(const Mission& mission, const std::filesystem::path& folder,
                             const Engine& engine);

/// A folder that appears under its name only when it is whole. The name must be free or an empty
/// folder: throws Error(config). Without commit() what was written is removed.
class NewFolder {
 public:
  explicit NewFolder(std::filesystem::path path);
  ~NewFolder();
  NewFolder(const NewFolder&) = delete;
  NewFolder& operator=(const NewFolder&) = delete;
  const std::filesystem::path& temporary() const { return temporary_; }
  void commit();  ///< throws Error(data)

 private:
  std::filesystem::path path_, temporary_;
};

}  // namespace cambium
