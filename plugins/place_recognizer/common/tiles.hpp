// SPDX-License-Identifier: BSD-3-Clause
// References in one byte a number, thirty-two side by side, as the kernels read them.
//
// A tile holds, one after the other:
//   codes   [frequencies][groups][32][4]  uint8   128 + round(number / scale)
//   scales  [frequencies][32]             uint16  the upper half of a float
//   error   [32] float   norm of (spectrum - what the codes say), rounded up
//   norm    [32] float   of the descriptor, rounded up
//   filled  [32] float   number of filled columns; 0 behind the last reference
//   masks   [32][words]  uint64  filled_columns()
// The numbers of a frequency are its real parts, its imaginary parts, and zeros up to a whole
// group.
#pragma once
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "common/spectrum.hpp"

namespace columns {

constexpr std::size_t lanes = 32;

struct TileLayout {
  explicit TileLayout(Shape shape)
      : codes(shape.frequencies() * shape.groups() * lanes * 4),
        scales(codes),
        error(scales + shape.frequencies() * lanes * sizeof(std::uint16_t)),
        norm(error + lanes * sizeof(float)),
        filled(norm + lanes * sizeof(float)),
        masks(filled + lanes * sizeof(float)),
        bytes((masks + lanes * shape.words() * sizeof(std::uint64_t) + 63) / 64 * 64) {}
  std::size_t codes;  ///< bytes; the others are offsets
  std::size_t scales, error, norm, filled, masks;
  std::size_t bytes;  ///< of a tile
};

/// A table of tiles begins so many bytes after its place in `extra`, and ends 16 bytes before the
/// next one's: glibc's large blocks begin 16 bytes into a page, so that each load is one cache
/// line. It is slower elsewhere, and no less right.
constexpr std::size_t tiles_begin = 48, tiles_end = 16;

inline std::size_t tile_count(std::size_t references) { return (references + lanes - 1) / lanes; }

/// Copies out what may lie anywhere in memory.
template <class T>
T read(const std::byte* from, std::size_t i = 0) {
  T value;
  std::memcpy(&value, from + i * sizeof(T), sizeof(T));
  return value;
}

/// Writes up to `lanes` descriptors into one tile of TileLayout(shape).bytes.
void encode_tile(std::span<const std::span<const float>> descriptors, const Transform& transform,
                 std::span<std::byte> tile);

}  // namespace columns
