// SPDX-License-Identifier: BSD-3-Clause
#include "cartesian.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace scan_context_pp {
namespace {

int bins_within(double half, double bin) { return std::max(1, 2 * int(std::round(half / bin))); }

}  // namespace

int CartesianGrid::lanes() const { return bins_within(width, bin); }
int CartesianGrid::stations() const { return bins_within(length, bin); }
std::size_t CartesianGrid::height_count() const {
  return std::size_t(lanes()) * std::size_t(stations() + 2 * steps);
}

std::vector<double> CartesianGrid::all_headings() const {
  std::vector<double> out = {0.0};
  for (int i = 1; i <= headings; ++i)
    for (const double side : {1.0, -1.0}) out.push_back(side * i * heading_step);
  return out;
}

std::vector<CartesianView> cartesian_views(const CartesianGrid& grid) {
  std::vector<CartesianView> out;
  for (std::size_t heading = 0; heading < grid.all_headings().size(); ++heading)
    for (int step = 0; step <= grid.steps; ++step)
      for (const bool reversed : {false, true}) {
        out.push_back({heading, step, reversed});
        if (step > 0) out.push_back({heading, -step, reversed});
      }
  return out;
}

// Bins start at 0 = empty, so taking the maximum also discards what is lower than -height_offset.
void measure_heights(const cambium::Cloud::Matrix3X& points, const CartesianGrid& grid,
                     double heading, double height_offset, std::span<float> heights) {
  std::fill(heights.begin(), heights.end(), 0.0f);
  const int along = grid.stations() + 2 * grid.steps, across = grid.lanes();
  const float cosine = float(std::cos(heading) / grid.bin),
              sine = float(std::sin(heading) / grid.bin);
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const float x = cosine * points(0, i) + sine * points(1, i) + 0.5f * float(along);
    const float y = cosine * points(1, i) - sine * points(0, i) + 0.5f * float(across);
    if (!(x >= 0 && x < float(along) && y >= 0 && y < float(across))) continue;
    float& height = heights[std::size_t(int(y) * along + int(x))];
    height = std::max(height, points(2, i) + float(height_offset));
  }
}

// A reversed view sees the last lane first and the last station first.
void describe(std::span<const float> heights, const CartesianGrid& grid, const CartesianView& view,
              std::span<float> descriptor) {
  std::fill(descriptor.begin(), descriptor.end(), 0.0f);
  const int seen = grid.stations(), along = seen + 2 * grid.steps, across = grid.lanes();
  for (int lane = 0; lane < across; ++lane) {
    const float* from = heights.data() + lane * along + grid.steps + view.ahead;
    const int to = view.reversed ? across - 1 - lane : lane;
    Eigen::Map<Eigen::VectorXf> column(descriptor.data() + to * seen, seen);
    column = Eigen::Map<const Eigen::VectorXf>(from, seen);
    if (view.reversed) column.reverseInPlace();
    column.stableNormalize();
  }
}

cambium::SE3 T_base_view(const CartesianGrid& grid, const CartesianView& view) {
  return cambium::SE3::from_yaw(grid.all_headings()[view.heading]) *
         cambium::SE3{cambium::Quat::Identity(), {view.ahead * grid.bin, 0, 0}} *
         cambium::SE3::from_yaw(view.reversed ? std::numbers::pi : 0.0);
}

}  // namespace scan_context_pp
