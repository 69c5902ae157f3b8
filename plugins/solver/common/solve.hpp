// SPDX-License-Identifier: BSD-3-Clause
// From a graph as files bring it to a Solution, around the minimisation that a plugin brings.
#pragma once
#include "cambium/kinds.hpp"
#include "common/settings.hpp"

namespace cambium::pose_solver {

/// Checks the graph, finds a start, runs the minimiser (within GNC when asked to), never ends above
/// the cost of the given poses, holds what is fixed to the last bit, and adds weights, figures and
/// the marginals that the graph asks for. Throws Error(numeric) naming the factor.
Solution solve(const Settings& settings, const PoseGraph& given, const Context& context,
               const MakeMinimizer& make);

/// The component of a plugin that minimises with `M`, made from a Problem.
template <class M>
class SolverWith final : public Solver {
 public:
  void params(ParamVisitor& v) override { settings_.params(v); }

  Solution solve(const PoseGraph& graph, const Context& context) const override {
    return pose_solver::solve(settings_, graph, context,
                              [](const Problem& problem) { return std::make_unique<M>(problem); });
  }

 private:
  Settings settings_;
};

}  // namespace cambium::pose_solver
