// SPDX-License-Identifier: BSD-3-Clause
#include "common/surface.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>

namespace cambium::filter {
namespace {

struct Moments {
  double count = 0;
  Vec3 sum = Vec3::Zero();
  double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;

  void add(const Vec3& p) {
    count += 1;
    sum += p;
    xx += p.x() * p.x(), xy += p.x() * p.y(), xz += p.x() * p.z();
    yy += p.y() * p.y(), yz += p.y() * p.z(), zz += p.z() * p.z();
  }
  void add(const Moments& o) {
    count += o.count;
    sum += o.sum;
    xx += o.xx, xy += o.xy, xz += o.xz, yy += o.yy, yz += o.yz, zz += o.zz;
  }
  Vec3 mean() const { return sum / count; }
};

struct Cell {
  std::uint64_t voxel;
  Moments own;
  Vec3 mean;
};

/// Cells with the same x and y: they follow one another.
struct Column {
  std::uint64_t xy;
  std::size_t begin, end;
};

constexpr int reach = 2;  // cells of radius / 2

std::uint64_t column_of(std::uint64_t voxel) { return voxel >> 21; }
std::int64_t layer_of(std::uint64_t voxel) { return std::int64_t(voxel & ((1u << 21) - 1)); }

std::vector<Column> columns_of(const std::vector<Cell>& cells) {
  std::vector<Column> out;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const std::uint64_t xy = column_of(cells[i].voxel);
    if (out.empty() || out.back().xy != xy) out.push_back({xy, i, i});
    out.back().end = i + 1;
  }
  return out;
}

/// Adds the cells of one column to the neighbourhoods of those of another.
void add_column(const std::vector<Cell>& cells, const Column& to, const Column& from,
                double squared_radius, std::vector<Moments>& around) {
  std::size_t low = from.begin;
  for (std::size_t i = to.begin; i < to.end; ++i) {
    const std::int64_t layer = layer_of(cells[i].voxel);
    while (low < from.end && layer_of(cells[low].voxel) < layer - reach) ++low;
    for (std::size_t k = low; k < from.end && layer_of(cells[k].voxel) <= layer + reach; ++k)
      if ((cells[k].mean - cells[i].mean).squaredNorm() <= squared_radius)
        around[i].add(cells[k].own);
  }
}

std::vector<Moments> neighbourhoods(const std::vector<Cell>& cells, double radius) {
  const std::vector<Column> columns = columns_of(cells);
  std::vector<Moments> around(cells.size());
  for (int dx = -reach; dx <= reach; ++dx)
    for (int dy = -reach; dy <= reach; ++dy) {
      // Columns are sorted, so the neighbour on one side never lies behind that of the one before.
      const std::uint64_t offset = std::uint64_t((std::int64_t(dx) * (1 << 21)) + dy);
      std::size_t k = 0;
      for (const Column& to : columns) {
        while (k < columns.size() && columns[k].xy < to.xy + offset) ++k;
        if (k < columns.size() && columns[k].xy == to.xy + offset)
          add_column(cells, to, columns[k], radius * radius, around);
      }
    }
  return around;
}

Shape shape_of(const Moments& m) {
  Shape out;
  out.points = int(m.count);
  const Vec3 mean = m.mean();
  out.mean = mean.cast<float>();
  Eigen::Matrix3d covariance;
  covariance << m.xx, m.xy, m.xz, m.xy, m.yy, m.yz, m.xz, m.yz, m.zz;
  covariance = covariance / m.count - mean * mean.transpose();
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen;
  eigen.computeDirect(covariance);
  const Eigen::Vector3d l = eigen.eigenvalues().cwiseMax(0.0);
  out.normal = eigen.eigenvectors().col(0).cast<float>();
  out.direction = eigen.eigenvectors().col(2).cast<float>();
  if (l.sum() > 0) out.variation = float(l[0] / l.sum());
  if (l[2] > 0) out.linearity = float((l[2] - l[1]) / l[2]);
  return out;
}

}  // namespace

Shapes::Shapes(const Cloud& cloud, double radius) : cell_of_(cloud.size()) {
  std::vector<Cell> cells;
  const auto points = cloud.points();
  constexpr std::uint32_t none = ~std::uint32_t(0);
  std::fill(cell_of_.begin(), cell_of_.end(), none);
  for (const auto& [voxel, point] : sorted_by_voxel(cloud, radius / reach)) {
    if (cells.empty() || cells.back().voxel != voxel) cells.push_back({voxel, {}, Vec3::Zero()});
    cells.back().own.add(points.col(point).cast<double>());
    cell_of_[point] = std::uint32_t(cells.size() - 1);
  }
  for (Cell& cell : cells) cell.mean = cell.own.mean();
  for (const Moments& m : neighbourhoods(cells, radius)) shapes_.push_back(shape_of(m));
  shapes_.emplace_back();
  std::replace(cell_of_.begin(), cell_of_.end(), none, std::uint32_t(shapes_.size() - 1));
}

}  // namespace cambium::filter
