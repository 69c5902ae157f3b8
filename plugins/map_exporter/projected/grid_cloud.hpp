// SPDX-License-Identifier: BSD-3-Clause
// A PLY file whose coordinates are doubles: a float has only half a metre at 7000 km.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "cambium/files.hpp"
#include "cambium/se3.hpp"

namespace projected {

class GridCloud {
 public:
  /// `remarks` become comments of the header.
  GridCloud(const std::filesystem::path& path, std::vector<std::string> remarks);
  void add(const cambium::Vec3& p, float intensity);
  void commit();
  std::size_t size() const { return size_; }

 private:
  std::string header() const;

  cambium::AtomicFile file_;
  std::vector<std::string> remarks_;
  std::size_t size_ = 0;
};

}  // namespace projected
