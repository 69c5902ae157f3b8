// SPDX-License-Identifier: BSD-3-Clause
#include "cambium/payload.hpp"

namespace cambium {
namespace {

template <class T>
void copy_row(const std::vector<T>& from, std::vector<T>& to, std::size_t i, std::size_t width) {
  if (from.empty()) return;
  to.insert(to.end(), from.begin() + std::ptrdiff_t(i * width),
            from.begin() + std::ptrdiff_t((i + 1) * width));
}

}  // namespace

Cloud select(const Cloud& cloud, const std::vector<std::size_t>& indices) {
  Cloud out;
  out.xyz.reserve(3 * indices.size());
  if (!cloud.normals.empty()) out.normals.reserve(3 * indices.size());
  if (!cloud.intensity.empty()) out.intensity.reserve(indices.size());
  if (!cloud.label.empty()) out.label.reserve(indices.size());
  for (const std::size_t i : indices) {
    copy_row(cloud.xyz, out.xyz, i, 3);
    copy_row(cloud.normals, out.normals, i, 3);
    copy_row(cloud.intensity, out.intensity, i, 1);
    copy_row(cloud.label, out.label, i, 1);
  }
  return out;
}

Cloud transformed(const SE3& T_target_source, const Cloud& cloud) {
  Cloud out = cloud;
  const Eigen::Matrix3d R = T_target_source.rotation();
  const Eigen::Vector3d t = T_target_source.t;
  const auto from = cloud.points();
  auto to = out.points();
  // In double: a map frame may be kilometres wide, where float products lose centimetres.
  for (Eigen::Index i = 0; i < from.cols(); ++i)
    to.col(i) = (R * from.col(i).cast<double>() + t).cast<float>();
  if (!out.normals.empty()) {
    Eigen::Map<Cloud::Matrix3X> n(out.normals.data(), 3, Eigen::Index(out.size()));
    n = R.cast<float>() * n.eval();
  }
  return out;
}

std::size_t Payload::bytes() const {
  return (cloud ? cloud->bytes() : 0) + (trees ? trees->capacity() * sizeof(Tree) : 0) +
         (images ? images->capacity() * sizeof(Image) : 0) +
         (imu ? imu->capacity() * sizeof(ImuSample) : 0);
}

}  // namespace cambium
