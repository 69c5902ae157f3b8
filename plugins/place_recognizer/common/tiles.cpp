// SPDX-License-Identifier: BSD-3-Clause
#include "common/tiles.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "common/filled.hpp"

namespace columns {
namespace {

template <class T>
void write(std::byte* to, std::size_t i, T value) {
  std::memcpy(to + i * sizeof(T), &value, sizeof(T));
}

/// The upper half of the least float of 8 significant bits that is not below x >= 0.
std::uint16_t upper_half(double x) {
  const auto bits = std::bit_cast<std::uint32_t>(std::nextafter(float(x), 2 * float(x)));
  return std::uint16_t((bits + 0xffff) >> 16);
}

float rounded_up(double x) { return float(x) * (1.0f + 1e-6f); }

class LaneWriter {
 public:
  LaneWriter(Shape shape, std::byte* tile, std::size_t lane)
      : shape_(shape), layout_(shape), tile_(tile), lane_(lane) {}

  void write_descriptor(std::span<const float> descriptor, const Transform& transform) {
    Eigen::MatrixXd spectrum = transform(descriptor);
    write(tile_ + layout_.norm, lane_, rounded_up(norm(shape_, spectrum)));
    for (std::size_t f = 0; f < shape_.frequencies(); ++f) write_frequency(f, spectrum);
    write(tile_ + layout_.error, lane_, rounded_up(norm(shape_, spectrum)));
    const auto mask = filled_columns(descriptor, shape_);
    write(tile_ + layout_.filled, lane_, float(count_bits(mask)));
    for (std::size_t w = 0; w < mask.size(); ++w)
      write(tile_ + layout_.masks, lane_ * mask.size() + w, mask[w]);
  }

 private:
  /// Leaves in `spectrum` what the codes miss.
  void write_frequency(std::size_t f, Eigen::MatrixXd& spectrum) {
    auto column = spectrum.col(Eigen::Index(f));
    const std::uint16_t half = upper_half(column.cwiseAbs().maxCoeff() / 127.0);
    const double scale = std::bit_cast<float>(std::uint32_t(half) << 16);
    write(tile_ + layout_.scales, f * lanes + lane_, half);
    for (Eigen::Index i = 0; i < column.size(); ++i) {
      const double code =
          scale > 0 ? std::clamp(std::nearbyint(column[i] / scale), -127.0, 127.0) : 0.0;
      const std::size_t group = f * shape_.groups() + std::size_t(i) / 4;
      tile_[(group * lanes + lane_) * 4 + std::size_t(i) % 4] = std::byte(int(code) + 128);
      column[i] -= code * scale;
    }
  }

  Shape shape_;
  TileLayout layout_;
  std::byte* tile_;
  std::size_t lane_;
};

}  // namespace

void encode_tile(std::span<const std::span<const float>> descriptors, const Transform& transform,
                 std::span<std::byte> tile) {
  const Shape shape = transform.shape();
  std::fill(tile.begin(), tile.end(), std::byte(0));
  std::fill_n(tile.begin(), TileLayout(shape).codes, std::byte(128));
  for (std::size_t lane = 0; lane < descriptors.size(); ++lane)
    LaneWriter(shape, tile.data(), lane).write_descriptor(descriptors[lane], transform);
}

}  // namespace columns
