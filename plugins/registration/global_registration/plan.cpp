// SPDX-License-Identifier: BSD-3-Clause
#include "plan.hpp"

#include <cmath>
#include <limits>

#include "level.hpp"

namespace cambium::registration {
namespace {

using Points = std::vector<Eigen::Vector2f>;

std::size_t wrapped(int cell, int width) { return std::size_t(cell & (width - 1)); }

/// Adds the points, turned, to the image: each shared between the four cells around it, so that
/// turning by little changes little. The root makes a wall, which has many points in a cell, count
/// like a stem rather than outvote it.
void draw(const Points& points, double turn, const PlanGrid& grid, std::vector<float>& image) {
  const auto c = float(std::cos(turn) / grid.cell), s = float(std::sin(turn) / grid.cell);
  image.assign(std::size_t(grid.width * grid.width), 0.0F);
  for (const Eigen::Vector2f& p : points) {
    const float x = c * p.x() - s * p.y(), y = s * p.x() + c * p.y();
    const float left = std::floor(x), low = std::floor(y), u = x - left, v = y - low;
    const std::size_t x0 = wrapped(int(left), grid.width), x1 = wrapped(int(left) + 1, grid.width);
    const std::size_t row = std::size_t(grid.width), y0 = row * wrapped(int(low), grid.width),
                      y1 = row * wrapped(int(low) + 1, grid.width);
    image[y0 + x0] += (1 - u) * (1 - v);
    image[y0 + x1] += u * (1 - v);
    image[y1 + x0] += (1 - u) * v;
    image[y1 + x1] += u * v;
  }
  for (float& value : image) value = std::sqrt(value);
}

/// Two real images were transformed as one complex image; takes them apart.
void split(const Image& both, int width, std::vector<std::complex<float>>& first,
           std::vector<std::complex<float>>* second) {
  const std::complex<float> half(0.5F, 0), half_i(0, -0.5F);
  for (int y = 0; y < width; ++y)
    for (int x = 0; x <= width / 2; ++x) {
      const auto at = [&](int i, int j) {
        const std::size_t k = wrapped(j, width) * std::size_t(width) + wrapped(i, width);
        return std::complex<float>(both.re[k], both.im[k]);
      };
      const std::complex<float> here = at(x, y), mirrored = std::conj(at(-x, -y));
      first.push_back(half * (here + mirrored));
      if (second) second->push_back(half_i * (here - mirrored));
    }
}

void enter_ground(const Eigen::Vector3f& p, const PlanGrid& grid, std::vector<float>& ground) {
  const std::size_t x = wrapped(int(std::lround(p.x() / grid.cell)), grid.width),
                    y = wrapped(int(std::lround(p.y() / grid.cell)), grid.width);
  float& lowest = ground[y * std::size_t(grid.width) + x];
  if (!(lowest <= p.z())) lowest = p.z();  // written so that NaN counts as higher
}

}  // namespace

std::size_t Plan::bytes() const {
  const std::size_t each =
      spectra.empty() ? 0 : spectra.front().size() * sizeof(std::complex<float>);
  return spectra.size() * each + ground.size() * sizeof(float);
}

Plan make_plan(const Patches& patches, const PlanGrid& grid, const Fft& fft) {
  Plan plan;
  plan.R_level_base = levelling(vertical(patches));
  plan.ground.assign(std::size_t(grid.width * grid.width), std::numeric_limits<float>::quiet_NaN());
  Points upright;
  for (const Patch& patch : patches) {
    const Eigen::Vector3f p = plan.R_level_base * patch.at, n = plan.R_level_base * patch.normal;
    if (!(p.head<2>().norm() < float(grid.max_range))) continue;
    enter_ground(p, grid, plan.ground);
    if (n.head<2>().norm() > 0.87F) upright.emplace_back(p.head<2>());  // within 30 degrees
  }
  plan.spectra.resize(std::size_t(grid.headings));
  for (int h = 0; h < grid.headings; h += 2) {
    Image both;
    draw(upright, grid.turn(h), grid, both.re);
    draw(upright, grid.turn(h + 1), grid, both.im);
    fft.forward(both);
    const bool last = h + 1 == grid.headings;
    split(both, grid.width, plan.spectra[std::size_t(h)],
          last ? nullptr : &plan.spectra[std::size_t(h) + 1]);
  }
  return plan;
}

}  // namespace cambium::registration
