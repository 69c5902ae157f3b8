// SPDX-License-Identifier: BSD-3-Clause
#include "correlate.hpp"

#include <algorithm>
#include <cmath>

namespace cambium::registration {
namespace {

struct Peak {
  float score;
  int heading;  ///< 0..2 headings - 1, over a whole turn
  int x, y;     ///< [cells], signed
};

int from_zero(std::size_t cell, int width) {
  return int(cell) < width / 2 ? int(cell) : int(cell) - width;
}

// With A, F the spectra of two real plans, A conj(F) is that of their correlation, and A F that of
// the correlation with the second one turned by half a turn. Both are real, so one transform gives
// both: its real and its imaginary part.
void multiply(const std::vector<std::complex<float>>& a, const std::vector<std::complex<float>>& f,
              int width, Image& out) {
  const int half = width / 2;
  for (int y = 0; y < width; ++y)
    for (int x = 0; x <= half; ++x) {
      const std::size_t k = std::size_t(y * (half + 1) + x);
      const float ar = a[k].real(), ai = a[k].imag(), fr = f[k].real(), fi = f[k].imag();
      const float p = ar * fr, q = ai * fi, r = ai * fr, s = ar * fi;
      // P = A conj(F) = (p + q) + i (r - s), Q = A F = (p - q) + i (r + s); store P + i Q, and at
      // the mirrored frequency conj(P) + i conj(Q).
      const std::size_t here = std::size_t(y * width + x);
      out.re[here] = (p + q) - (r + s);
      out.im[here] = (r - s) + (p - q);
      if (x == 0 || x == half) continue;
      const std::size_t mirrored = std::size_t((width - y) % width * width + width - x);
      out.re[mirrored] = (p + q) + (r + s);
      out.im[mirrored] = (p - q) - (r - s);
    }
}

// The best of every tile of 8 x 8 cells.
void collect(const std::vector<float>& correlation, int heading, int width, double reach,
             std::vector<Peak>& peaks) {
  constexpr int tile = 8;
  const auto n = std::size_t(width);
  for (std::size_t y0 = 0; y0 < n; y0 += tile)
    for (std::size_t x0 = 0; x0 < n; x0 += tile) {
      std::size_t best = y0 * n + x0;
      for (std::size_t y = y0; y < y0 + tile; ++y)
        for (std::size_t x = x0; x < x0 + tile; ++x)
          if (correlation[y * n + x] > correlation[best]) best = y * n + x;
      const Peak peak{correlation[best], heading, from_zero(best % n, width),
                      from_zero(best / n, width)};
      if (std::hypot(peak.x, peak.y) <= reach) peaks.push_back(peak);
    }
}

bool same(const Peak& a, const Peak& b, int headings) {
  const int turn = std::abs(a.heading - b.heading);
  return std::abs(a.x - b.x) <= 3 && std::abs(a.y - b.y) <= 3 &&
         std::min(turn, 2 * headings - turn) <= 2;
}

/// What lifts the source's ground onto the target's: the median over cells that both have.
double height(const Plan& target, const Plan& source, const PlanGrid& grid, const Peak& peak) {
  const double turn = grid.turn(peak.heading), c = std::cos(turn), s = std::sin(turn);
  const auto n = std::size_t(grid.width);
  std::vector<float> lifts;
  for (std::size_t k = 0; k < source.ground.size(); ++k) {
    if (std::isnan(source.ground[k])) continue;
    const int x = from_zero(k % n, grid.width), y = from_zero(k / n, grid.width);
    const int i = int(std::lround(c * x - s * y)) + peak.x,
              j = int(std::lround(s * x + c * y)) + peak.y;
    if (std::max(std::abs(i), std::abs(j)) >= grid.width / 2) continue;
    const float below =
        target.ground[std::size_t(j & (grid.width - 1)) * n + std::size_t(i & (grid.width - 1))];
    if (!std::isnan(below)) lifts.push_back(below - source.ground[k]);
  }
  if (lifts.empty()) return 0;
  const auto middle = lifts.begin() + std::ptrdiff_t(lifts.size() / 2);
  std::nth_element(lifts.begin(), middle, lifts.end());
  return *middle;
}

SE3 rotation(const Eigen::Matrix3f& R) {
  Mat4 T = Mat4::Identity();
  T.topLeftCorner<3, 3>() = R.cast<double>();
  return SE3::from_matrix(T);
}

}  // namespace

std::vector<Hypothesis> correlate(const Plan& target, const Plan& source, const PlanGrid& grid,
                                  const Fft& fft, double max_distance, std::size_t count) {
  std::vector<Peak> peaks;
  const auto cells = std::size_t(grid.width * grid.width);
  Image product{std::vector<float>(cells), std::vector<float>(cells)};
  for (int h = 0; h < grid.headings; ++h) {
    multiply(target.spectra.front(), source.spectra[std::size_t(h)], grid.width, product);
    fft.backward(product);
    collect(product.re, h, grid.width, max_distance / grid.cell, peaks);
    collect(product.im, h + grid.headings, grid.width, max_distance / grid.cell, peaks);
  }
  std::stable_sort(peaks.begin(), peaks.end(),
                   [](const Peak& a, const Peak& b) { return a.score > b.score; });
  std::vector<Peak> kept;
  for (const Peak& p : peaks) {
    if (kept.size() >= count) break;
    if (std::none_of(kept.begin(), kept.end(), [&](auto& k) { return same(k, p, grid.headings); }))
      kept.push_back(p);
  }
  const SE3 T_base_level = rotation(target.R_level_base).inverse(),
            T_level_base = rotation(source.R_level_base);
  std::vector<Hypothesis> out;
  for (const Peak& p : kept) {
    const Vec3 t(p.x * grid.cell, p.y * grid.cell, height(target, source, grid, p));
    out.push_back({p.score / float(cells),
                   T_base_level * SE3::from_yaw(grid.turn(p.heading), t) * T_level_base});
  }
  return out;
}

}  // namespace cambium::registration
