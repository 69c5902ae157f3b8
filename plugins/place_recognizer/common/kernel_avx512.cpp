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

#define COLUMNS_AVX512 [[gnu::target("avx512f,avx512bw,avx512dq,avx512vl,avx512vnni,popcnt")]]

struct Registers {
  static constexpr std::size_t width = 16;
  COLUMNS_AVX512 static unsigned not_negative(const float* x) {
    const unsigned low = _mm512_movepi32_mask(_mm512_castps_si512(_mm512_loadu_ps(x)));
    const unsigned high = _mm512_movepi32_mask(_mm512_castps_si512(_mm512_loadu_ps(x + 16)));
    return ~(low | high << 16);
  }
};

/// From sums of codes to a cross spectrum, of sixteen lanes of a frequency; returns its absolute.
COLUMNS_AVX512 [[gnu::always_inline]] inline __m512 finish(__m512i re, __m512i im,
                                                           const std::byte* scales, float gain,
                                                           float* cross) {
  const __m512i half =
      _mm512_cvtepu16_epi32(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(scales)));
  const __m512 scale =
      _mm512_mul_ps(_mm512_castsi512_ps(_mm512_slli_epi32(half, 16)), _mm512_set1_ps(gain));
  const __m512 x = _mm512_mul_ps(_mm512_cvtepi32_ps(re), scale);
  const __m512 y = _mm512_mul_ps(_mm512_cvtepi32_ps(im), scale);
  _mm512_storeu_ps(cross, x);
  _mm512_storeu_ps(cross + lanes, y);
  const __m512 square =
      _mm512_max_ps(_mm512_fmadd_ps(x, x, _mm512_mul_ps(y, y)), _mm512_set1_ps(1e-30f));
  return _mm512_mul_ps(square, _mm512_rsqrt14_ps(square));
}

/// As many queries as registers can hold the sums of: each code of the tile is read once for all of
/// them. `groups` is shape.groups(), a constant for the usual shape.
template <std::size_t count, bool fetch_ahead>
COLUMNS_AVX512 [[gnu::always_inline]] inline void screen_groups(Shape shape, std::size_t groups,
                                                                const std::byte* tile,
                                                                Screening* queries) {
  const TileLayout layout(shape);
  const std::byte* codes = tile;
  __m512 low[count], high[count];
#pragma GCC unroll 4
  for (std::size_t q = 0; q < count; ++q) low[q] = high[q] = _mm512_setzero_ps();
  for (std::size_t f = 0; f < shape.frequencies(); ++f) {
    __m512i re_low[count], re_high[count], im_low[count], im_high[count];
    const std::int8_t* of_query[count];
#pragma GCC unroll 4
    for (std::size_t q = 0; q < count; ++q) {
      re_low[q] = re_high[q] = _mm512_set1_epi32(queries[q].query->offsets[2 * f]);
      im_low[q] = im_high[q] = _mm512_set1_epi32(queries[q].query->offsets[2 * f + 1]);
      of_query[q] = queries[q].query->codes.data() + f * 8 * groups;
    }
    for (std::size_t g = 0; g < groups; ++g, codes += 4 * lanes) {
      if constexpr (fetch_ahead) {
        _mm_prefetch(codes + layout.bytes, _MM_HINT_T1);
        _mm_prefetch(codes + layout.bytes + 64, _MM_HINT_T1);
      }
      const __m512i of_low = _mm512_loadu_si512(codes), of_high = _mm512_loadu_si512(codes + 64);
#pragma GCC unroll 4
      for (std::size_t q = 0; q < count; ++q) {
        std::int32_t real, imaginary;  // four codes each
        std::memcpy(&real, of_query[q] + 4 * g, 4);
        std::memcpy(&imaginary, of_query[q] + 4 * (groups + g), 4);
        const __m512i reals = _mm512_set1_epi32(real), imaginaries = _mm512_set1_epi32(imaginary);
        re_low[q] = _mm512_dpbusd_epi32(re_low[q], of_low, reals);
        re_high[q] = _mm512_dpbusd_epi32(re_high[q], of_high, reals);
        im_low[q] = _mm512_dpbusd_epi32(im_low[q], of_low, imaginaries);
        im_high[q] = _mm512_dpbusd_epi32(im_high[q], of_high, imaginaries);
      }
    }
    const std::byte* scale = tile + layout.scales + f * lanes * 2;
#pragma GCC unroll 4
    for (std::size_t q = 0; q < count; ++q) {
      const float gain = queries[q].query->gains[f];
      float* to = queries[q].cross + 2 * f * lanes;
      low[q] = _mm512_add_ps(low[q], finish(re_low[q], im_low[q], scale, gain, to));
      high[q] = _mm512_add_ps(high[q], finish(re_high[q], im_high[q], scale + 32, gain, to + 16));
    }
  }
  const __m512 up = _mm512_set1_ps(1.0f + 0x1p-12f);  // rsqrt14: 2^-14
  for (std::size_t q = 0; q < count; ++q) {
    float sums[lanes];
    _mm512_storeu_ps(sums, _mm512_mul_ps(low[q], up));
    _mm512_storeu_ps(sums + 16, _mm512_mul_ps(high[q], up));
    queries[q].possible = possible<Registers>(shape, tile, queries[q], sums);
  }
}

template <std::size_t count>
COLUMNS_AVX512 [[gnu::always_inline]] inline void screen_some(Shape shape, const std::byte* tile,
                                                              Screening* queries,
                                                              bool fetch_ahead) {
  const std::size_t groups = shape.groups();
  if (fetch_ahead)
    groups == usual_groups ? screen_groups<count, true>(shape, usual_groups, tile, queries)
                           : screen_groups<count, true>(shape, groups, tile, queries);
  else
    groups == usual_groups ? screen_groups<count, false>(shape, usual_groups, tile, queries)
                           : screen_groups<count, false>(shape, groups, tile, queries);
}

COLUMNS_AVX512 void screen(Shape shape, const std::byte* tile, std::span<Screening> queries,
                           bool fetch_ahead) {
  std::size_t q = 0;
  for (; q + 4 <= queries.size(); q += 4)
    screen_some<4>(shape, tile, &queries[q], fetch_ahead && q == 0);
  for (; q < queries.size(); ++q) screen_some<1>(shape, tile, &queries[q], fetch_ahead && q == 0);
}

COLUMNS_AVX512 unsigned weigh(const InverseTransform& inverse, const std::byte* tile,
                              const Screening& screened, float* sums) {
  return weigh_lanes<Registers>(inverse, tile, screened, sums);
}

COLUMNS_AVX512 float dot(const float* a, const float* b, std::size_t count) {
  return dot_product(a, b, count);
}

}  // namespace

const Kernel avx512_kernel = {"avx512vnni", screen, weigh, dot};

bool can_run_avx512() {
  return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
         __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl") &&
         __builtin_cpu_supports("avx512vnni");
}

}  // namespace columns
#endif
