// SPDX-License-Identifier: BSD-3-Clause
// Random numbers that depend on their keys only: the same for any order of work and any thread
// count. The distributions of the standard library differ between implementations, so they are
// spelled out here.
#pragma once
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string_view>

namespace cambium::simulate {

/// The finaliser of SplitMix64 (Steele, Lea, Flood, OOPSLA 2014).
constexpr std::uint64_t mix(std::uint64_t z) {
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
  return z ^ (z >> 31);
}

/// FNV-1a, so that a stream is named by a word in the code.
constexpr std::uint64_t key_of(std::string_view word) {
  std::uint64_t h = 0xCBF29CE484222325u;
  for (const char c : word) h = (h ^ std::uint64_t(static_cast<unsigned char>(c))) * 0x100000001B3u;
  return h;
}

/// One stream: SplitMix64 from a state made of the keys. Random(seed, "lean", stem) is another
/// stream for every stem.
class Random {
 public:
  template <class... Keys>
  explicit Random(std::uint64_t seed, std::string_view purpose, Keys... keys)
      : state_(mix(seed + golden) ^ key_of(purpose)) {
    ((state_ = mix(state_ + golden) ^ std::uint64_t(keys)), ...);
    state_ = mix(state_ + golden);
  }

  std::uint64_t next() { return mix(state_ += golden); }
  /// The stream of item `i`; cheaper than naming it.
  Random fork(std::uint64_t i) const {
    Random r(*this);
    r.state_ = mix(state_ ^ mix(i + golden));
    return r;
  }

  double uniform() { return double(next() >> 11) * 0x1.0p-53; }  ///< [0, 1)
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// Standard normal; Box and Muller 1958. Two draws a number, so streams have no hidden state.
  double normal() {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
    return radius * std::cos(2.0 * std::numbers::pi * uniform());
  }
  double exponential(double mean) { return -mean * std::log(1.0 - uniform()); }
  /// F(x) = 1 - exp(-(x / scale)^shape)
  double weibull(double shape, double scale) {
    return scale * std::pow(-std::log(1.0 - uniform()), 1.0 / shape);
  }
  /// Knuth's product of uniforms: for means of a few, as of one cell of a grid.
  int poisson(double mean) {
    const double limit = std::exp(-mean);
    int k = 0;
    for (double p = uniform(); p > limit; p *= uniform()) ++k;
    return k;
  }

 private:
  static constexpr std::uint64_t golden = 0x9E3779B97F4A7C15u;
  std::uint64_t state_;
};

}  // namespace cambium::simulate
