// SPDX-License-Identifier: BSD-3-Clause
// What a node saw. Values are immutable once shared; sources load lazily.
#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "cambium/digest.hpp"
#include "cambium/se3.hpp"

namespace cambium {

/// Points in the base frame of their node [m], 12 bytes each.
struct Cloud {
  using Matrix3X = Eigen::Matrix<float, 3, Eigen::Dynamic>;
  std::vector<float> xyz;        ///< x y z x y z ..., 3 * size()
  std::vector<float> normals;    ///< empty or 3 * size(), unit length
  std::vector<float> intensity;  ///< empty or size()
  std::vector<std::uint8_t> label;  ///< empty or size(): ground, trunk, ...; codes in docs/formats.md

  std::size_t size() const { return xyz.size() / 3; }
  bool empty() const { return xyz.empty(); }
  Eigen::Map<const Matrix3X> points() const { return {xyz.data(), 3, Eigen::Index(size())}; }
  Eigen::Map<Matrix3X> points() { return {xyz.data(), 3, Eigen::Index(size())}; }
  std::size_t bytes() const {
    return (xyz.capacity() + normals.capacity() + intensity.capacity()) * sizeof(float) +
           label.capacity();
  }
};

/// Copies the points (with their normals, intensities and labels) at `indices`, in that order.
Cloud select(const Cloud& cloud, const std::vector<std::size_t>& indices);
/// Moves points and normals: p_target = T_target_source * p_source.
Cloud transformed(const SE3& T_target_source, const Cloud& cloud);

/// One detected tree, in the base frame of its node.
struct Tree {
  Vec3 base = Vec3::Zero();    ///< stem base [m]
  Vec3 axis = Vec3::UnitZ();   ///< unit vector up along the stem
  double dbh = 0;              ///< diameter at breast height [m]; NaN when not measured
  double score = 0;            ///< of the detector, 0..1
  bool reconstructed = false;  ///< a stem was modelled, not only detected
};

/// A picture, which stays in its file: an exporter copies it, a page shows it.
struct Image {
  std::filesystem::path file;  ///< .jpg, .jpeg, .png or .webp
  std::string camera;          ///< "cam0"; empty where there is only one
};

/// What an inertial sensor measured, in its own axes.
struct ImuSample {
  std::int64_t stamp = 0;                   ///< nanoseconds since 1970
  Vec3 angular_velocity = Vec3::Zero();     ///< [rad/s]
  Vec3 acceleration = Vec3::Zero();         ///< with gravity [m/s^2]
};

/// Any member may be null: the node has no such payload.
struct Payload {
  std::shared_ptr<const Cloud> cloud;
  std::shared_ptr<const std::vector<Tree>> trees;
  std::shared_ptr<const std::vector<Image>> images = {};   ///< taken at the node, by camera
  std::shared_ptr<const std::vector<ImuSample>> imu = {};  ///< from the node to the next one

  std::size_t bytes() const;
};

/// Where a payload comes from. `load` may be called from several threads at once.
class PayloadSource {
 public:
  virtual ~PayloadSource() = default;
  virtual Payload load() const = 0;         ///< throws Error(data) naming the file
  virtual Digest digest() const = 0;        ///< of the content: equal digests, equal payloads
  virtual std::string where() const = 0;    ///< for messages, e.g. the path
};

}  // namespace cambium
