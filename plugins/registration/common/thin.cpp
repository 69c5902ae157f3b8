// SPDX-License-Identifier: BSD-3-Clause
#include "common/thin.hpp"

#include <array>
#include <cmath>

namespace cambium::registration {
namespace {

using Points = Eigen::Map<const Eigen::Matrix3Xf>;

struct Keyed {
  std::uint64_t key;
  std::uint32_t point;
};

// From the frame's origin, so that a far stray point moves no voxel.
constexpr int farthest = 1 << 20;

bool voxel_of(const Points& points, Eigen::Index i, double per_metre, Eigen::Array3i& voxel) {
  for (int k = 0; k < 3; ++k) {
    const double v = std::floor(double(points(k, i)) * per_metre);
    if (!(std::abs(v) < farthest)) return false;  // written so that NaN fails
    voxel[k] = int(v);
  }
  return true;
}

// Block by block, 19 bits an axis, and 6 bits for the voxel within the block.
std::uint64_t key_of(const Eigen::Array3i& voxel) {
  std::uint64_t block = 0, within = 0;
  for (int k = 0; k < 3; ++k) {
    const auto v = std::uint64_t(voxel[k] + farthest);
    block = block << 19 | v >> 2;
    within = within << 2 | (v & 3);
  }
  return block << 6 | within;
}

// Radix sort: stable, so points of one voxel keep their order. Digits that all keys share cost
// one look.
void sort_by_key(std::vector<Keyed>& items) {
  std::vector<Keyed> other(items.size());
  for (int shift = 0; shift < 63; shift += 9) {
    std::array<std::uint32_t, 513> start{};
    for (const Keyed& item : items) ++start[(item.key >> shift & 511) + 1];
    if (start[(items.front().key >> shift & 511) + 1] == items.size()) continue;
    for (std::size_t d = 1; d < start.size(); ++d) start[d] += start[d - 1];
    for (const Keyed& item : items) other[start[item.key >> shift & 511]++] = item;
    items.swap(other);
  }
}

void open_block(std::uint64_t block, Thinned& out) {
  Eigen::Array3i place;
  for (int k = 2; k >= 0; --k, block >>= 19) place[k] = int(block & ((1 << 19) - 1)) - farthest / 4;
  out.first.push_back(out.points.size());
  out.blocks.push_back(place);
}

Thinned thin(const Points& points, double voxel_size) {
  std::vector<Keyed> items;
  items.reserve(std::size_t(points.cols()));
  Eigen::Array3i voxel;
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    if (voxel_of(points, i, 1 / voxel_size, voxel))
      items.push_back({key_of(voxel), std::uint32_t(i)});
  Thinned out;
  out.voxel_size = voxel_size;
  if (!items.empty()) sort_by_key(items);
  for (std::size_t i = 0; i < items.size();) {
    const std::uint64_t key = items[i].key;
    if (i == 0 || key >> 6 != items[i - 1].key >> 6) open_block(key >> 6, out);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    const std::size_t begin = i;
    for (; i < items.size() && items[i].key == key; ++i)
      sum += points.col(Eigen::Index(items[i].point)).cast<double>();
    out.points.push_back((sum / double(i - begin)).cast<float>());
    out.voxel.push_back(std::uint8_t(key & 63));
  }
  out.first.push_back(out.points.size());
  return out;
}

}  // namespace

Thinned thin(const Cloud& cloud, double voxel_size) {
  return thin(Points(cloud.xyz.data(), 3, Eigen::Index(cloud.size())), voxel_size);
}

Thinned thin(const std::vector<Eigen::Vector3f>& points, double voxel_size) {
  const float* data = points.empty() ? nullptr : points.front().data();
  return thin(Points(data, 3, Eigen::Index(points.size())), voxel_size);
}

}  // namespace cambium::registration
