// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

namespace cambium::registration {

/// Square complex images, row by row, real and imaginary parts apart.
struct Image {
  std::vector<float> re, im;
};

/// The two-dimensional discrete Fourier transform of images of one size, a power of two from 16 on.
class Fft {
 public:
  explicit Fft(int width);
  /// F(k) = sum over x of f(x) exp(-2 pi i k x / width), in place.
  void forward(Image& image) const { transform(image, image.re, image.im); }
  /// The inverse without the factor 1 / width^2.
  void backward(Image& image) const { transform(image, image.im, image.re); }
  int width() const { return width_; }

 private:
  void transform(Image& image, std::vector<float>& re, std::vector<float>& im) const;
  void columns(const float* re, const float* im, float* re_out, float* im_out) const;

  int width_;
  std::vector<int> reversed_;     ///< bits of each index in reverse
  std::vector<float> cos_, sin_;  ///< of 2 pi k / width
};

}  // namespace cambium::registration
