// SPDX-License-Identifier: BSD-3-Clause
#include "cloud_file.hpp"

#include <pcl/console/print.h>
#include <pcl/io/pcd_io.h>
#include <pcl/io/ply_io.h>

#include <cmath>
#include <cstring>
#include <initializer_list>
#include <optional>

#include "cambium/error.hpp"
#include "cloud_header.hpp"
#include "las_cloud.hpp"

namespace cambium {
namespace {

using Field = pcl::PCLPointField;

const Field* find_field(const pcl::PCLPointCloud2& blob, std::initializer_list<const char*> names) {
  for (const char* name : names)
    for (const Field& field : blob.fields)
      if (field.name == name) return &field;
  return nullptr;
}

template <class T>
float read_as(const std::uint8_t* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return float(value);
}

float value_of(const Field& field, const std::uint8_t* point) {
  const std::uint8_t* bytes = point + field.offset;
  switch (field.datatype) {
    case Field::FLOAT32:
      return read_as<float>(bytes);
    case Field::FLOAT64:
      return read_as<double>(bytes);
    case Field::UINT8:
      return read_as<std::uint8_t>(bytes);
    case Field::INT8:
      return read_as<std::int8_t>(bytes);
    case Field::UINT16:
      return read_as<std::uint16_t>(bytes);
    case Field::INT16:
      return read_as<std::int16_t>(bytes);
    case Field::UINT32:
      return read_as<std::uint32_t>(bytes);
    case Field::INT32:
      return read_as<std::int32_t>(bytes);
    default:
      return std::nanf("");
  }
}

/// Nothing, where the field holds no code.
std::uint8_t label_of(const Field& field, const std::uint8_t* point) {
  const float value = value_of(field, point);
  return value >= 0 && value <= 255 ? std::uint8_t(value) : 0;
}

/// Three fields that belong together, or nothing when one is missing.
using Triple = std::array<const Field*, 3>;
std::optional<Triple> normal_fields(const pcl::PCLPointCloud2& blob) {
  const Triple f = {find_field(blob, {"normal_x", "nx"}), find_field(blob, {"normal_y", "ny"}),
                    find_field(blob, {"normal_z", "nz"})};
  if (!f[0] || !f[1] || !f[2]) return std::nullopt;
  return f;
}

// A normal that is not finite or has no length says nothing; zero marks it.
void append_normal(const Triple& fields, const std::uint8_t* point, std::vector<float>& out) {
  Eigen::Vector3f n(value_of(*fields[0], point), value_of(*fields[1], point),
                    value_of(*fields[2], point));
  const float norm = n.norm();
  n = norm > 1e-6f && std::isfinite(norm) ? Eigen::Vector3f(n / norm) : Eigen::Vector3f::Zero();
  out.insert(out.end(), n.data(), n.data() + 3);
}

LoadedCloud from_pcl(const pcl::PCLPointCloud2& blob, const std::filesystem::path& path) {
  const Triple xyz = {find_field(blob, {"x"}), find_field(blob, {"y"}), find_field(blob, {"z"})};
  for (const Field* field : xyz)
    if (!field || (field->datatype != Field::FLOAT32 && field->datatype != Field::FLOAT64))
      throw Error(ErrorCode::data, path.string(), "expected x, y and z as float or double");
  const auto normals = normal_fields(blob);
  const Field* intensity = find_field(blob, {"intensity", "scalar_Intensity", "scalar_intensity"});
  const Field* label = find_field(blob, {"label", "classification", "scalar_Classification"});
  LoadedCloud out;
  const std::size_t points = std::size_t(blob.width) * blob.height;
  out.cloud.xyz.reserve(3 * points);
  if (normals) out.cloud.normals.reserve(3 * points);
  if (intensity) out.cloud.intensity.reserve(points);
  if (label) out.cloud.label.reserve(points);
  for (std::size_t i = 0; i < points; ++i) {
    const std::uint8_t* point = blob.data.data() + i * blob.point_step;
    const float p[3] = {value_of(*xyz[0], point), value_of(*xyz[1], point),
                        value_of(*xyz[2], point)};
    if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2])) {
      ++out.not_finite;
      continue;
    }
    out.cloud.xyz.insert(out.cloud.xyz.end(), p, p + 3);
    if (normals) append_normal(*normals, point, out.cloud.normals);
    if (intensity) out.cloud.intensity.push_back(value_of(*intensity, point));
    if (label) out.cloud.label.push_back(label_of(*label, point));
  }
  return out;
}

SE3 viewpoint_pose(const Eigen::Vector4f& origin, const Eigen::Quaternionf& orientation,
                   const std::filesystem::path& path) {
  SE3 T{Quat(orientation.w(), orientation.x(), orientation.y(), orientation.z()),
        origin.head<3>().cast<double>()};
  const double norm = T.q.norm();
  if (!T.finite() || norm < 1e-3)
    throw Error(ErrorCode::data, path.string(),
                "the viewpoint is no pose; set apply_viewpoint: false");
  T.q.coeffs() /= norm;
  return T;
}

}  // namespace

LoadedCloud load_cloud(const std::filesystem::path& path, bool apply_viewpoint) {
  if (path.extension() == ".las" || path.extension() == ".laz") return load_las(path);
  // PCL prints what it dislikes; libraries of Cambium do not. What fails is thrown below.
  static const bool quiet = (pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS), true);
  static_cast<void>(quiet);
  if (checked_point_count(path) == 0) return {};
  pcl::PCLPointCloud2 blob;
  Eigen::Vector4f origin = Eigen::Vector4f::Zero();
  Eigen::Quaternionf orientation = Eigen::Quaternionf::Identity();
  int version = 0, status = -1;
  try {
    status = path.extension() == ".ply"
                 ? pcl::PLYReader().read(path.string(), blob, origin, orientation, version)
                 : pcl::PCDReader().read(path.string(), blob, origin, orientation, version);
  } catch (const std::exception& error) {
    throw Error(ErrorCode::data, path.string(), std::string("cannot be read: ") + error.what());
  }
  if (status < 0 || blob.data.size() < std::size_t(blob.width) * blob.height * blob.point_step)
    throw Error(ErrorCode::data, path.string(),
                "its points cannot be read; the file is damaged behind its header");
  LoadedCloud out = from_pcl(blob, path);
  if (apply_viewpoint)
    out.cloud = transformed(viewpoint_pose(origin, orientation, path), out.cloud);
  return out;
}

}  // namespace cambium
