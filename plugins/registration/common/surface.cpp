// SPDX-License-Identifier: BSD-3-Clause
#include "common/surface.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <bit>
#include <cstdlib>

namespace cambium::registration {
namespace {

constexpr int farthest = 4;  // [voxels] for a plane; a block's neighbours reach that far

/// First and second moments of points about one of them, which is counted.
struct Moments {
  int count = 1;
  Eigen::Vector3f first = Eigen::Vector3f::Zero();
  float xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;

  void add(const Eigen::Vector3f& d) {
    first += d;
    xx += d.x() * d.x();
    xy += d.x() * d.y();
    xz += d.x() * d.z();
    yy += d.y() * d.y();
    yz += d.y() * d.z();
    zz += d.z() * d.z();
    ++count;
  }
  Eigen::Matrix3d covariance() const {
    Eigen::Matrix3d second;
    second << xx, xy, xz, xy, yy, yz, xz, yz, zz;
    const Eigen::Vector3d mean = first.cast<double>() / count;
    return second / count - mean * mean.transpose();
  }
};

/// The points of the 27 blocks around one, by voxel.
class Neighbourhood {
 public:
  explicit Neighbourhood(const Thinned& cloud) : cloud_(cloud) {}

  void move_to(const BlockIndex& index, std::size_t block) {
    column_.fill(0);
    for (int x = 0; x < 3; ++x)
      for (int y = 0; y < 3; ++y)
        for (int z = 0; z < 3; ++z) {
          const std::int32_t b = index.around(block, x, y, z);
          if (b >= 0) enter(std::size_t(b), 4 * x, 4 * y, 4 * z);
        }
  }

  /// Adds the points `shell` voxels away from point `i` (of the block in the middle).
  void add_shell(std::size_t i, int shell, Moments& m) const {
    const int v = cloud_.voxel[i], x0 = (v >> 4) + farthest, y0 = (v >> 2 & 3) + farthest,
              z0 = (v & 3) + farthest;
    const std::uint32_t slab = ((2U << 2 * shell) - 1) << (z0 - shell);
    const std::uint32_t lids = 1U << (z0 - shell) | 1U << (z0 + shell);
    for (int x = x0 - shell; x <= x0 + shell; ++x)
      for (int y = y0 - shell; y <= y0 + shell; ++y) {
        const bool side = std::abs(x - x0) == shell || std::abs(y - y0) == shell;
        const auto column = std::size_t(x * width + y);
        for (std::uint32_t z = column_[column] & (side ? slab : lids); z != 0; z &= z - 1)
          m.add(points_[column * width + std::size_t(std::countr_zero(z))] - cloud_.points[i]);
      }
  }

 private:
  static constexpr int width = 12;
  void enter(std::size_t block, int x, int y, int z) {
    for (std::size_t i = cloud_.first[block]; i < cloud_.first[block + 1]; ++i) {
      const int v = cloud_.voxel[i];
      const auto column = std::size_t((x + (v >> 4)) * width + y + (v >> 2 & 3));
      column_[column] |= std::uint16_t(1U << (z + (v & 3)));
      points_[column * width + std::size_t(z + (v & 3))] = cloud_.points[i];
    }
  }

  const Thinned& cloud_;
  std::array<std::uint16_t, width * width> column_;            ///< bit z: there is a point
  std::array<Eigen::Vector3f, width * width * width> points_;  ///< only where the bit is set
};

// The smallest principal axis. Points in a row (a far scan line on the ground) have none.
Eigen::Vector3f normal_of(const Moments& moments) {
  constexpr double row = 0.01;  // variance across the row over that along it
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes;
  axes.computeDirect(moments.covariance());
  if (moments.count < 3 || !(axes.eigenvalues()[1] > row * axes.eigenvalues()[2]))
    return Eigen::Vector3f::Zero();
  return axes.eigenvectors().col(0).cast<float>();
}

}  // namespace

Patches sample(const Patches& patches, std::size_t limit) {
  const std::size_t step = (patches.size() + limit - 1) / limit;
  Patches out;
  for (std::size_t i = 0; i < patches.size(); i += step) out.push_back(patches[i]);
  return out;
}

Surface make_surface(const Thinned& cloud, int neighbours) {
  Surface out{Patches(cloud.points.size()), BlockIndex(cloud)};
  Neighbourhood around(cloud);
  for (std::size_t b = 0; b < cloud.blocks.size(); ++b) {
    around.move_to(out.index, b);
    for (std::size_t i = cloud.first[b]; i < cloud.first[b + 1]; ++i) {
      Moments moments;
      for (int shell = 1; shell <= farthest && moments.count < neighbours; ++shell)
        around.add_shell(i, shell, moments);
      const Eigen::Vector3f n = normal_of(moments);
      out.patches[i] = {cloud.points[i], n.dot(cloud.points[i]) > 0 ? Eigen::Vector3f(-n) : n};
    }
  }
  return out;
}

}  // namespace cambium::registration
