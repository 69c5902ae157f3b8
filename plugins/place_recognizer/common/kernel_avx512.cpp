// SPDX-License-Identifier: BSD-3-Clause
// The code is for one instruction set by attribute, not by a flag for the whole file: a flag would
// also reach inline functions of the libraries, which the linker shares with the rest of the
// plugin.
#include "common/kernel_x86.hpp"

#ifdef COLUMNS_X86
#include <immintrin.h>

#include "common/kernel_parts.hpp"

namespace columns {
namespace {

#define COLUMNS_AVX512 [[gnu::target("avx512f,avx512bw,avx512vl,avx512vnni,popcnt")]]

/// `groups` is shape.groups(), a constant for the usual shape. Unrolled twice: ten times is slower.
COLUMNS_AVX512 [[gnu::always_inline]] inline unsigned screen_groups(Shape shape, std::size_t groups,
                                                                    const std::byte* tile,
                                                                    const CoarseQuery& query,
                                                                    const Screening& screening,
                                                                    float* cross) {
  const TileLayout layout(shape);
  const std::byte* codes = tile;
  const std::byte* scales = tile + layout.scales;
  const std::int8_t* of_query = query.codes.data();
  const __m512 tiny = _mm512_set1_ps(1e-30f);
  __m512 sum = _mm512_setzero_ps();
  for (std::size_t f = 0; f < shape.frequencies(); ++f) {
    __m512i re = _mm512_set1_epi32(query.offsets[2 * f]);
    __m512i im = _mm512_set1_epi32(query.offsets[2 * f + 1]);
#pragma GCC unroll 2
    for (std::size_t g = 0; g < groups; ++g, codes += 64, of_query += 4) {
      if (screening.fetch_ahead) _mm_prefetch(codes + layout.bytes, _MM_HINT_T1);
      std::int32_t real, imaginary;  // four codes each
      std::memcpy(&real, of_query, 4);
      std::memcpy(&imaginary, of_query + 4 * groups, 4);
      const __m512i references = _mm512_loadu_si512(codes);
      re = _mm512_dpbusd_epi32(re, references, _mm512_set1_epi32(real));
      im = _mm512_dpbusd_epi32(im, references, _mm512_set1_epi32(imaginary));
    }
    of_query += 4 * groups;
    const __m512i half = _mm512_cvtepu16_epi32(
        _mm256_loadu_si256(reinterpret_cast<const __m256i*>(scales + f * lanes * 2)));
    const __m512 scale = _mm512_mul_ps(_mm512_castsi512_ps(_mm512_slli_epi32(half, 16)),
                                       _mm512_set1_ps(query.gains[f]));
    const __m512 x = _mm512_mul_ps(_mm512_cvtepi32_ps(re), scale);
    const __m512 y = _mm512_mul_ps(_mm512_cvtepi32_ps(im), scale);
    _mm512_storeu_ps(cross + 2 * f * lanes, x);
    _mm512_storeu_ps(cross + (2 * f + 1) * lanes, y);
    const __m512 square = _mm512_max_ps(_mm512_fmadd_ps(x, x, _mm512_mul_ps(y, y)), tiny);
    sum = _mm512_fmadd_ps(square, _mm512_rsqrt14_ps(square), sum);  // the root of the square
  }
  Lanes sums;
  _mm512_storeu_ps(&sums, sum);
  return possible(shape, tile, query, screening, sums * (1.0f + 0x1p-12f));  // rsqrt14: 2^-14
}

COLUMNS_AVX512 unsigned screen(Shape shape, const std::byte* tile, const CoarseQuery& query,
                               const Screening& screening, float* cross) {
  if (shape.groups() == usual_groups)
    return screen_groups(shape, usual_groups, tile, query, screening, cross);
  return screen_groups(shape, shape.groups(), tile, query, screening, cross);
}

COLUMNS_AVX512 unsigned weigh(const InverseTransform& inverse, const std::byte* tile,
                              const CoarseQuery& query, const Screening& screening,
                              const float* cross, unsigned possible, float* sums) {
  return weigh_lanes(inverse, tile, query, screening, cross, possible, sums);
}

COLUMNS_AVX512 float dot(const float* a, const float* b, std::size_t count) {
  return dot_product(a, b, count);
}

}  // namespace

const Kernel avx512_kernel = {"avx512vnni", screen, weigh, dot};

bool can_run_avx512() {
  return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
         __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512vnni");
}

}  // namespace columns
#endif
