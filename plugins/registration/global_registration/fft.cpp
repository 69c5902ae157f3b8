// SPDX-License-Identifier: BSD-3-Clause
// Radix 2, decimation in time (Cooley, Tukey 1965), on strips of columns side by side: the inner
// loops run over the strip, so the compiler takes several columns at once and the strip stays in
// the first cache.
#include "fft.hpp"

#include <array>
#include <cmath>

namespace cambium::registration {
namespace {

constexpr int strip = 16;  // columns
using Row = std::array<float, strip>;

// (a, b) <- (a + w b, a - w b)
void butterfly(Row& a_re, Row& a_im, Row& b_re, Row& b_im, float w_re, float w_im) {
  for (std::size_t c = 0; c < strip; ++c) {
    const float re = w_re * b_re[c] - w_im * b_im[c], im = w_re * b_im[c] + w_im * b_re[c];
    b_re[c] = a_re[c] - re;
    b_im[c] = a_im[c] - im;
    a_re[c] += re;
    a_im[c] += im;
  }
}

}  // namespace

Fft::Fft(int width) : width_(width), reversed_(std::size_t(width)) {
  for (int i = 0; i < width; ++i) {
    for (int bit = 1, mirrored = width / 2; bit < width; bit *= 2, mirrored /= 2)
      if (i & bit) reversed_[std::size_t(i)] |= mirrored;
    cos_.push_back(float(std::cos(2 * M_PI * i / width)));
    sin_.push_back(float(std::sin(2 * M_PI * i / width)));
  }
}

// Transforms along the columns and writes the result transposed.
void Fft::columns(const float* re, const float* im, float* re_out, float* im_out) const {
  const auto n = std::size_t(width_);
  std::vector<Row> a(n), b(n);
  for (std::size_t first = 0; first < n; first += strip) {
    for (std::size_t row = 0; row < n; ++row)
      for (std::size_t c = 0; c < strip; ++c) {
        const std::size_t from = std::size_t(reversed_[row]) * n + first + c;
        a[row][c] = re[from];
        b[row][c] = im[from];
      }
    for (std::size_t half = 1; half < n; half *= 2)
      for (std::size_t k = 0; k < half; ++k) {
        const std::size_t turn = k * (n / (2 * half));
        for (std::size_t row = k; row < n; row += 2 * half)
          butterfly(a[row], b[row], a[row + half], b[row + half], cos_[turn], -sin_[turn]);
      }
    for (std::size_t c = 0; c < strip; ++c)
      for (std::size_t row = 0; row < n; ++row) {
        re_out[(first + c) * n + row] = a[row][c];
        im_out[(first + c) * n + row] = b[row][c];
      }
  }
}

// Swapping the parts before and after turns the transform into its inverse.
void Fft::transform(Image& image, std::vector<float>& re, std::vector<float>& im) const {
  Image other{std::vector<float>(image.re.size()), std::vector<float>(image.im.size())};
  columns(re.data(), im.data(), other.re.data(), other.im.data());
  columns(other.re.data(), other.im.data(), re.data(), im.data());
}

}  // namespace cambium::registration
