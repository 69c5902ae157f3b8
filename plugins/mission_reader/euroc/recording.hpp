// SPDX-License-Identifier: BSD-3-Clause
// The tables of a recording in the layout of the EuRoC MAV data sets (Burri et al. 2016).
#pragma once
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "cambium/mission.hpp"

namespace euroc {

struct TimedPose {
  cambium::Stamp stamp;
  cambium::SE3 T_mission_body;
};

/// Rows of timestamp [ns], position [m], quaternion w x y z; more columns (velocities, biases) are
/// left alone. Throws Error(data, file:line): another number of columns, no pose, stamps that do
/// not ascend, a quaternion of no length.
std::vector<TimedPose> read_poses(const std::filesystem::path& table);

/// Rows of timestamp [ns], angular velocity [rad/s], acceleration [m/s^2]; the same errors.
std::vector<cambium::ImuSample> read_imu(const std::filesystem::path& table);

/// The frames of a camera by their time [ns]: rows of timestamp and file name, which lies in data/
/// beside the table. Files that are not there go to `missing`.
std::map<std::int64_t, std::filesystem::path> read_frames(const std::filesystem::path& table,
                                                          std::vector<std::string>& missing);

/// What a node saw: frames, and the samples up to the next node.
class NodePayload final : public cambium::PayloadSource {
 public:
  NodePayload(std::vector<cambium::Image> images,
              std::shared_ptr<const std::vector<cambium::ImuSample>> all, std::size_t begin,
              std::size_t end, std::string where)
      : images_(std::move(images)), all_(all), begin_(begin), end_(end), where_(where) {}

  cambium::Payload load() const override;
  cambium::Digest digest()
      const override;  ///< of the samples, and of names and sizes of the pictures
  std::string where() const override { return where_; }

 private:
  std::vector<cambium::Image> images_;
  std::shared_ptr<const std::vector<cambium::ImuSample>> all_;
  std::size_t begin_, end_;
  std::string where_;
};

/// Nanoseconds since 1970, and back.
std::int64_t nanoseconds(const cambium::Stamp& stamp);
cambium::Stamp stamp_of(std::int64_t nanoseconds);

}  // namespace euroc
