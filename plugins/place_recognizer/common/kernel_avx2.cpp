// SPDX-License-Identifier: BSD-3-Clause
#include "common/kernel_x86.hpp"

#ifdef COLUMNS_X86
#include <immintrin.h>

#include "common/kernel_parts.hpp"

namespace columns {
namespace {

#define COLUMNS_AVX2 [[gnu::target("avx2,fma,popcnt")]]

struct Registers {
  static constexpr std::size_t width = 16;
  COLUMNS_AVX2 static unsigned not_negative(const float* x) {
    unsigned below = 0;
    for (unsigned lane = 0; lane < lanes; lane += 8)
      below |= unsigned(_mm256_movemask_ps(_mm256_loadu_ps(x + lane))) << lane;
    return ~below;
  }
};

// Products of bytes, summed by four. The pairs between fit into 16 bits: see largest_code.
COLUMNS_AVX2 inline __m256i add_products(__m256i sum, __m256i references, std::int32_t codes) {
  const __m256i pairs = _mm256_maddubs_epi16(references, _mm256_set1_epi32(codes));
  return _mm256_add_epi32(sum, _mm256_madd_epi16(pairs, _mm256_set1_epi16(1)));
}

/// Eight lanes of one frequency; returns |cross|.
COLUMNS_AVX2 [[gnu::always_inline]] inline __m256 multiply(const std::byte* codes,
                                                           const std::byte* scales,
                                                           const CoarseQuery& query, std::size_t f,
                                                           std::size_t groups, float* cross,
                                                           std::size_t ahead) {
  const std::int8_t* of_query = query.codes.data() + f * 8 * groups;
  __m256i re = _mm256_set1_epi32(query.offsets[2 * f]);
  __m256i im = _mm256_set1_epi32(query.offsets[2 * f + 1]);
#pragma GCC unroll 10
  for (std::size_t g = 0; g < groups; ++g, codes += 4 * lanes, of_query += 4) {
    if (ahead != 0) _mm_prefetch(codes + ahead, _MM_HINT_T1);
    std::int32_t real, imaginary;
    std::memcpy(&real, of_query, 4);
    std::memcpy(&imaginary, of_query + 4 * groups, 4);
    const __m256i references = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(codes));
    re = add_products(re, references, real);
    im = add_products(im, references, imaginary);
  }
  const __m256i half =
      _mm256_cvtepu16_epi32(_mm_loadu_si128(reinterpret_cast<const __m128i*>(scales)));
  const __m256 scale = _mm256_mul_ps(_mm256_castsi256_ps(_mm256_slli_epi32(half, 16)),
                                     _mm256_set1_ps(query.gains[f]));
  const __m256 x = _mm256_mul_ps(_mm256_cvtepi32_ps(re), scale);
  const __m256 y = _mm256_mul_ps(_mm256_cvtepi32_ps(im), scale);
  _mm256_storeu_ps(cross, x);
  _mm256_storeu_ps(cross + lanes, y);
  const __m256 square =
      _mm256_max_ps(_mm256_fmadd_ps(x, x, _mm256_mul_ps(y, y)), _mm256_set1_ps(1e-30f));
  return _mm256_mul_ps(square, _mm256_rsqrt_ps(square));
}

/// `groups` is shape.groups(); where the compiler knows it, it unrolls the inner loop.
COLUMNS_AVX2 [[gnu::always_inline]] inline void screen_groups(Shape shape, std::size_t groups,
                                                              const std::byte* tile,
                                                              Screening& screening,
                                                              bool fetch_ahead) {
  const TileLayout layout(shape);
  const CoarseQuery& query = *screening.query;
  __m256 sum[lanes / 8] = {};
  for (std::size_t f = 0; f < shape.frequencies(); ++f)
    for (std::size_t part = 0; part < lanes / 8; ++part)
      sum[part] =
          _mm256_add_ps(sum[part], multiply(tile + f * groups * 4 * lanes + part * 32,
                                            tile + layout.scales + f * lanes * 2 + part * 16, query,
                                            f, groups, screening.cross + 2 * f * lanes + part * 8,
                                            part % 2 == 0 && fetch_ahead ? layout.bytes : 0));
  float sums[lanes];
  for (std::size_t part = 0; part < lanes / 8; ++part)  // rsqrt: 1.5 * 2^-12
    _mm256_storeu_ps(sums + part * 8, _mm256_mul_ps(sum[part], _mm256_set1_ps(1.0f + 0x1p-10f)));
  screening.possible = possible<Registers>(shape, tile, screening, sums);
}

COLUMNS_AVX2 void screen(Shape shape, const std::byte* tile, std::span<Screening> queries,
                         bool fetch_ahead) {
  for (Screening& query : queries) {
    const bool ahead = fetch_ahead && &query == queries.data();
    if (shape.groups() == usual_groups)
      screen_groups(shape, usual_groups, tile, query, ahead);
    else
      screen_groups(shape, shape.groups(), tile, query, ahead);
  }
}

COLUMNS_AVX2 unsigned weigh(const InverseTransform& inverse, const std::byte* tile,
                            const Screening& screened, float* sums) {
  return weigh_lanes<Registers>(inverse, tile, screened, sums);
}

COLUMNS_AVX2 float dot(const float* a, const float* b, std::size_t count) {
  return dot_product(a, b, count);
}

}  // namespace

const Kernel avx2_kernel = {"avx2", screen, weigh, dot};

bool can_run_avx2() { return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"); }

}  // namespace columns
#endif
