// SPDX-License-Identifier: BSD-3-Clause
#include "common/neighbours.hpp"

#include <algorithm>

#include "cambium/path.hpp"

namespace cambium::filter {

std::vector<std::size_t> neighbours(const Mission& mission, std::size_t node, double radius,
                                    double spacing) {
  const std::vector<double> path = travelled(mission);
  std::vector<std::size_t> out{node};
  for (std::size_t i = node, last = node; i-- > 0 && path[node] - path[i] <= radius;)
    if (path[last] - path[i] >= spacing) out.push_back(last = i);
  std::reverse(out.begin(), out.end());
  for (std::size_t i = node + 1, last = node; i < path.size() && path[i] - path[node] <= radius;
       ++i)
    if (path[i] - path[last] >= spacing) out.push_back(last = i);
  return out;
}

}  // namespace cambium::filter
