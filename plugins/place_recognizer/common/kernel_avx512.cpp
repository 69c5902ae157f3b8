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

/// `groups` is shape.groups(), a constant for the usual shape. All lanes at once: four chains of
/// sums that do not wait for one another, and each of the query's numbers is read once.
template <bool fetch_ahead>
COLUMNS_AVX512 [[gnu::always_inline]] inline unsigned screen_groups(Shape shape, std::size_t groups,
                                                                    const std::byte* tile,
                                                                    const CoarseQuery& query,
                                                                    const Screening& screening,
                                                                    float* cross) {
  const TileLayout layout(shape);
  const std::byte* codes = tile;
  const std::byte* scales = tile + layout.scales;
  const std::int8_t* of_query = query.codes.data();
  __m512 low = _mm512_setzero_ps(), high = _mm512_setzero_ps();
  for (std::size_t f = 0; f < shape.frequencies(); ++f, of_query += 4 * groups) {
    __m512i re_low = _mm512_set1_epi32(query.offsets[2 * f]), re_high = re_low;
    __m512i im_low = _mm512_set1_epi32(query.offsets[2 * f + 1]), im_high = im_low;
    for (std::size_t g = 0; g < groups; ++g, codes += 4 * lanes, of_query += 4) {
      if constexpr (fetch_ahead) {
        _mm_prefetch(codes + layout.bytes, _MM_HINT_T1);
        _mm_prefetch(codes + layout.bytes + 64, _MM_HINT_T1);
      }
      std::int32_t real, imaginary;  // four codes each
      std::memcpy(&real, of_query, 4);
      std::memcpy(&imaginary, of_query + 4 * groups, 4);
      const __m512i of_low = _mm512_loadu_si512(codes), of_high = _mm512_loadu_si512(codes + 64);
      const __m512i reals = _mm512_set1_epi32(real), imaginaries = _mm512_set1_epi32(imaginary);
      re_low = _mm512_dpbusd_epi32(re_low, of_low, reals);
      re_high = _mm512_dpbusd_epi32(re_high, of_high, reals);
      im_low = _mm512_dpbusd_epi32(im_low, of_low, imaginaries);
      im_high = _mm512_dpbusd_epi32(im_high, of_high, imaginaries);
    }
    const std::byte* scale = scales + f * lanes * 2;
    float* to = cross + 2 * f * lanes;
    low = _mm512_add_ps(low, finish(re_low, im_low, scale, query.gains[f], to));
    high = _mm512_add_ps(high, finish(re_high, im_high, scale + 32, query.gains[f], to + 16));
  }
  const __m512 up = _mm512_set1_ps(1.0f + 0x1p-12f);  // rsqrt14: 2^-14
  float sums[lanes];
  _mm512_storeu_ps(sums, _mm512_mul_ps(low, up));
  _mm512_storeu_ps(sums + 16, _mm512_mul_ps(high, up));
  return possible<Registers>(shape, tile, query, screening, sums);
}

COLUMNS_AVX512 unsigned screen(Shape shape, const std::byte* tile, const CoarseQuery& query,
                               const Screening& screening, float* cross) {
  const bool usual = shape.groups() == usual_groups;
  const std::size_t groups = shape.groups();
  if (screening.fetch_ahead)
    return usual ? screen_groups<true>(shape, usual_groups, tile, query, screening, cross)
                 : screen_groups<true>(shape, groups, tile, query, screening, cross);
  return usual ? screen_groups<false>(shape, usual_groups, tile, query, screening, cross)
               : screen_groups<false>(shape, groups, tile, query, screening, cross);
}

COLUMNS_AVX512 unsigned weigh(const InverseTransform& inverse, const std::byte* tile,
                              const CoarseQuery& query, const Screening& screening,
                              const float* cross, unsigned possible, float* sums) {
  return weigh_lanes<Registers>(inverse, tile, query, screening, cross, possible, sums);
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
