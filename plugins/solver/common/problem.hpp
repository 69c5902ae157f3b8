// SPDX-License-Identifier: BSD-3-Clause
// What every step of a solution looks at.
#pragma once
#include "common/checks.hpp"
#include "common/elimination.hpp"
#include "common/topology.hpp"

namespace cambium::pose_solver {

struct Problem {
  /// Throws and warns as checked() and warn_of_topology() do.
  Problem(const PoseGraph& given, const Context& context)
      : graph(checked(given, context)),
        component(components(graph)),
        held(held_nodes(graph, component)),
        elimination(graph, held) {
    warn_of_topology(graph, component, held, context);
  }

  PoseGraph graph;
  std::vector<std::size_t> component;  ///< of each node
  std::vector<bool> held;
  Elimination elimination;  ///< over all factors
};

}  // namespace cambium::pose_solver
