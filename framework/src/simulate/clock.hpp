// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cmath>

#include "cambium/mission.hpp"

namespace cambium::simulate {

/// `time` seconds after the Unix time `start`, to the nanosecond.
inline Stamp stamp_at(std::int64_t start, double time) {
  constexpr std::int64_t second = 1'000'000'000;
  const std::int64_t ns = std::llround(time * 1e9);
  return {start + ns / second, std::int32_t(ns % second)};
}

}  // namespace cambium::simulate
