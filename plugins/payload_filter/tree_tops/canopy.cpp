// SPDX-License-Identifier: BSD-3-Clause
#include "canopy.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace tree_tops {
namespace {

using cambium::Cloud;
using cambium::Vec3;

constexpr double nothing = std::numeric_limits<double>::infinity();
// Grids larger than this are of points that no forest explains [cells].
constexpr double max_cells = 4e6;

class Grid {
 public:
  Grid(const Eigen::Array2d& low, const Eigen::Array2d& high, double cell, double value)
      : low_(low), cell_(cell) {
    // A few stray points far away must not make the grid larger than memory.
    while ((((high - low) / cell_).floor() + 1).prod() > max_cells) cell_ *= 2;
    columns_ = int((high.x() - low.x()) / cell_) + 1;
    rows_ = int((high.y() - low.y()) / cell_) + 1;
    values_.assign(std::size_t(columns_) * std::size_t(rows_), value);
  }
  int columns() const { return columns_; }
  int rows() const { return rows_; }
  double cell() const { return cell_; }
  bool inside(int c, int r) const { return c >= 0 && r >= 0 && c < columns_ && r < rows_; }
  double& at(int c, int r) {
    return values_[std::size_t(r) * std::size_t(columns_) + std::size_t(c)];
  }
  double at(int c, int r) const { return const_cast<Grid&>(*this).at(c, r); }
  int column(double x) const { return int((x - low_.x()) / cell_); }
  int row(double y) const { return int((y - low_.y()) / cell_); }
  double& under(const Vec3& p) { return at(column(p.x()), row(p.y())); }
  double under(const Vec3& p) const { return at(column(p.x()), row(p.y())); }

 private:
  Eigen::Array2d low_;
  double cell_;
  int columns_ = 0, rows_ = 0;
  std::vector<double> values_;
};

/// z(cell) = min over all cells of z + slope * distance: two sweeps of a chamfer distance
/// (G. Borgefors, 1986).
void limit_slope(Grid& ground, double slope) {
  const double straight = slope * ground.cell(), diagonal = std::sqrt(2.0) * straight;
  const auto take = [&](int c, int r, int dc, int dr) {
    if (!ground.inside(c + dc, r + dr)) return;
    const double step = dc != 0 && dr != 0 ? diagonal : straight;
    ground.at(c, r) = std::min(ground.at(c, r), ground.at(c + dc, r + dr) + step);
  };
  for (int r = 0; r < ground.rows(); ++r)
    for (int c = 0; c < ground.columns(); ++c)
      take(c, r, -1, 0), take(c, r, -1, -1), take(c, r, 0, -1), take(c, r, 1, -1);
  for (int r = ground.rows() - 1; r >= 0; --r)
    for (int c = ground.columns() - 1; c >= 0; --c)
      take(c, r, 1, 0), take(c, r, 1, 1), take(c, r, 0, 1), take(c, r, -1, 1);
}

/// Where the canopy hides the ground, it is taken as stretched between the ground around
/// (Laplace's equation, by relaxation).
void fill_hidden(const Grid& lowest, Grid& ground) {
  constexpr int sweeps = 100;
  constexpr double touches = 0.05;  // the envelope lies on what is ground [m]
  for (int sweep = 0; sweep < sweeps; ++sweep)
    for (int r = 0; r < ground.rows(); ++r)
      for (int c = 0; c < ground.columns(); ++c) {
        if (lowest.at(c, r) <= ground.at(c, r) + touches) continue;
        double sum = 0, count = 0;
        for (const auto& [dc, dr] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}})
          if (ground.inside(c + dc, r + dr)) sum += ground.at(c + dc, r + dr), ++count;
        if (count > 0) ground.at(c, r) = std::min(lowest.at(c, r), sum / count);
      }
}

/// Whether no cell within `radius` is higher; of equal ones the first counts.
bool is_top(const Grid& surface, int c, int r, double radius) {
  const int reach = int(std::ceil(radius / surface.cell()));
  const double z = surface.at(c, r);
  for (int dr = -reach; dr <= reach; ++dr)
    for (int dc = -reach; dc <= reach; ++dc) {
      if ((dc == 0 && dr == 0) || !surface.inside(c + dc, r + dr)) continue;
      if (std::hypot(dc, dr) * surface.cell() > radius) continue;
      const double other = surface.at(c + dc, r + dr);
      const bool earlier = dc < 0 || (dc == 0 && dr < 0);
      if (other > z || (other == z && earlier)) return false;
    }
  return true;
}

/// The mean of the points of the cell and its neighbours that reach almost as high: a crown's
/// middle, not the branch that happens to be the highest.
Vec3 crown_centre(const std::vector<Vec3>& points, const Vec3& top, double radius) {
  Vec3 sum = Vec3::Zero();
  double weight = 0;
  for (const Vec3& p : points) {
    if ((p - top).head<2>().norm() > radius || p.z() < top.z() - 1.0) continue;
    sum += p;
    weight += 1;
  }
  return sum / weight;
}

std::vector<Vec3> finite_points(const Cloud& cloud, Eigen::Array2d& low, Eigen::Array2d& high) {
  std::vector<Vec3> out;
  low.setConstant(nothing), high.setConstant(-nothing);
  for (Eigen::Index i = 0; i < cloud.points().cols(); ++i) {
    const Eigen::Vector3d p = cloud.points().col(i).cast<double>();
    if (!p.allFinite() || p.norm() > 1e5) continue;
    out.emplace_back(p);
    low = low.min(p.head<2>().array()), high = high.max(p.head<2>().array());
  }
  return out;
}

}  // namespace

std::vector<Top> find_tops(const Cloud& levelled, const Limits& limits) {
  Eigen::Array2d low, high;
  const std::vector<Vec3> points = finite_points(levelled, low, high);
  if (points.empty()) return {};
  Grid ground(low, high, limits.ground_cell, nothing), surface(low, high, limits.cell, -nothing);
  for (const Vec3& p : points) {
    ground.under(p) = std::min(ground.under(p), p.z());
    surface.under(p) = std::max(surface.under(p), p.z());
  }
  const Grid lowest = ground;
  limit_slope(ground, std::tan(limits.max_slope * std::numbers::pi / 180));
  fill_hidden(lowest, ground);
  // Points near a candidate are looked up through their cells.
  std::vector<std::vector<std::uint32_t>> in_cell(std::size_t(surface.columns()) *
                                                  std::size_t(surface.rows()));
  const auto cell_of = [&](int c, int r) -> auto& {
    return in_cell[std::size_t(r) * std::size_t(surface.columns()) + std::size_t(c)];
  };
  for (std::uint32_t i = 0; i < points.size(); ++i)
    cell_of(surface.column(points[i].x()), surface.row(points[i].y())).push_back(i);
  std::vector<Top> out;
  for (int c = 0; c < surface.columns(); ++c)
    for (int r = 0; r < surface.rows(); ++r) {
      if (surface.at(c, r) == -nothing) continue;
      Vec3 top = Vec3::Zero();
      for (const std::uint32_t i : cell_of(c, r))
        if (points[i].z() == surface.at(c, r)) {
          top = points[i];
          break;
        }
      const double height = top.z() - ground.under(top);
      if (height < limits.min_height) continue;
      const double radius = limits.crown + limits.crown_growth * height;
      if (!is_top(surface, c, r, radius)) continue;
      std::vector<Vec3> near;
      const int reach = int(std::ceil(radius / surface.cell()));
      for (int dc = -reach; dc <= reach; ++dc)
        for (int dr = -reach; dr <= reach; ++dr)
          if (surface.inside(c + dc, r + dr))
            for (const std::uint32_t i : cell_of(c + dc, r + dr)) near.push_back(points[i]);
      const Vec3 centre = crown_centre(near, top, radius);
      out.push_back({{centre.x(), centre.y(), ground.under(centre)}, height});
    }
  return out;
}

}  // namespace tree_tops
