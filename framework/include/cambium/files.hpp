// SPDX-License-Identifier: BSD-3-Clause
// Files that are whole or absent, and trajectories.
#pragma once
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "cambium/mission.hpp"

namespace cambium {

std::string read_file(const std::filesystem::path& path);  ///< throws Error(data)

/// Writes to a temporary file beside `path`; commit() makes it appear under its name. A writer that
/// is destroyed without commit() removes what it wrote.
class AtomicFile {
 public:
  enum class Durability { synced, rename_only };  ///< synced survives a power cut
  explicit AtomicFile(std::filesystem::path path, Durability durability = Durability::synced);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;
  std::ostream& stream() { return out_; }
  /// For writers that open files by name themselves: write here, then commit().
  const std::filesystem::path& temporary() const { return temporary_; }
  void commit();  ///< throws Error(data) when anything could not be written (a full disk)

 private:
  std::filesystem::path path_, temporary_;
  std::ofstream out_;
  Durability durability_;
  bool committed_ = false;
};

void write_file(const std::filesystem::path& path, std::string_view text);  ///< atomically

/// One row of a TUM trajectory: stamp x y z qx qy qz qw.
struct StampedPose {
  Stamp stamp;
  SE3 T_map_node;
};
/// Stamps are read exactly, up to nanoseconds. `where` names the text in messages.
std::vector<StampedPose> parse_tum(std::string_view text, const std::filesystem::path& where);
std::vector<StampedPose> read_tum(const std::filesystem::path& path);  ///< throws Error(file:line)
std::string format_tum(const std::vector<StampedPose>& poses);

}  // namespace cambium
