// SPDX-License-Identifier: BSD-3-Clause
#include "point.hpp"

#include <cmath>

namespace web_view {

std::optional<Point> quantised(const cambium::Vec3& p_map) {
  const cambium::Vec3 u = units_per_metre * p_map;
  constexpr double reach = 1 << (position_bits - 1);
  // Also false for a point that is not finite.
  if (!(u.cwiseAbs().maxCoeff() < reach && u.allFinite())) return std::nullopt;
  const auto whole = [](double v) { return std::int32_t(std::floor(v + 0.5)); };
  return Point{whole(u.x()), whole(u.y()), whole(u.z())};
}

std::uint64_t mixed(std::uint64_t v) {
  v += 0x9e3779b97f4a7c15ull;
  v = (v ^ (v >> 30)) * 0xbf58476d1ce4e5b9ull;
  v = (v ^ (v >> 27)) * 0x94d049bb133111ebull;
  return v ^ (v >> 31);
}

}  // namespace web_view
