// SPDX-License-Identifier: BSD-3-Clause
#include "bins.hpp"

#include <algorithm>
#include <cstdio>

namespace loops {

using cambium::Vec3;

std::optional<std::size_t> Bins::of(double distance) const {
  if (distance < low() || distance >= high()) return std::nullopt;
  return std::size_t(std::upper_bound(edges_.begin(), edges_.end(), distance) - edges_.begin()) - 1;
}

std::string Bins::name(std::size_t bin) const {
  char text[64];
  std::snprintf(text, sizeof text, "%g-%g", edges_[bin], edges_[bin + 1]);
  return text;
}

std::vector<std::size_t> close_pairs(const cambium::Truth& truth, const Bins& bins,
                                     const cambium::Context& context) {
  std::vector<std::vector<Vec3>> missions;
  for (const auto& T_world_node : truth.T_world_node) {
    auto& positions = missions.emplace_back();
    for (const auto& T : T_world_node)
      if (T) positions.push_back(T->t);
  }
  std::vector<std::size_t> out(bins.size());
  for (std::size_t a = 0; a < missions.size(); ++a)
    for (const Vec3& p : missions[a]) {
      context.check_cancelled();
      for (std::size_t b = a + 1; b < missions.size(); ++b)
        for (const Vec3& q : missions[b]) {
          // Cheaper than a bin for the many pairs that are far apart.
          if ((p - q).squaredNorm() > bins.high() * bins.high()) continue;
          if (const auto bin = bins.of((p - q).norm())) ++out[*bin];
        }
    }
  return out;
}

}  // namespace loops
