// SPDX-License-Identifier: BSD-3-Clause
#include "common/solve.hpp"

#include <fmt/format.h>

#include "common/checks.hpp"
#include "common/costs.hpp"
#include "common/gnc.hpp"
#include "common/report.hpp"
#include "common/start.hpp"

namespace cambium::pose_solver {
namespace {

/// Minimisation never climbs, but it may fail; then the given poses stand.
void keep_the_better(const PoseGraph& graph, const Weights& weights, const Loss& loss,
                     Minimum& minimum) {
  const double before = robust_cost(graph, graph.T_map_node, weights, loss);
  const double after = robust_cost(graph, minimum.T_map_node, weights, loss);
  if (!(after <= before)) minimum.T_map_node = graph.T_map_node;
  minimum.message += fmt::format("; F {:.6g} -> {:.6g}", before, std::min(after, before));
}

GncResult minimise(const Settings& settings, Minimizer& minimizer, const PoseGraph& graph,
                   const std::vector<SE3>& start, const Loss& loss, const Context& context) {
  if (settings.gnc())
    return graduate(minimizer, graph, start, settings.loss_width, settings.limits, context);
  const Weights weights = unit_weights(graph);
  return {minimizer.run(start, weights, loss, settings.limits, context), weights};
}

}  // namespace

Solution solve(const Settings& settings, const PoseGraph& given, const Context& context,
               const MakeMinimizer& make) {
  const PoseGraph graph = checked(given, context);
  const Loss loss = settings.gnc() ? Loss() : Loss(loss_from(settings.loss), settings.loss_width);
  const auto component = components(graph);
  const auto held = held_nodes(graph, component);
  const auto start =
      settings.initialization == "given"
          ? graph.T_map_node
          : chordal_start(graph, component, held,
                          settings.gnc() ? Loss(LossKind::dcs, settings.loss_width) : loss);
  context.check_cancelled();
  const auto minimizer = make(graph, held);
  auto [minimum, weights] = minimise(settings, *minimizer, graph, start, loss, context);
  keep_the_better(graph, weights, loss, minimum);
  for (std::size_t i = 0; i < held.size(); ++i)  // to the last bit
    if (held[i]) minimum.T_map_node[i] = given.T_map_node[i];

  Solution out;
  out.T_map_node = std::move(minimum.T_map_node);
  out.iterations = minimum.iterations;
  out.converged = minimum.converged;
  out.message = std::move(minimum.message);
  out.weight = final_weights(graph, out.T_map_node, weights, loss);
  if (settings.diagnostics || !graph.marginals.empty())
    report_equations(graph, held, weights, loss, settings.diagnostics, out);
  if (settings.certify) report_certificate(graph, weights, loss, context, out);
  return out;
}

}  // namespace cambium::pose_solver
