// SPDX-License-Identifier: BSD-3-Clause
#include "common/solve.hpp"

#include <fmt/format.h>

#include "common/calibration.hpp"
#include "common/costs.hpp"
#include "common/gnc.hpp"
#include "common/one_thread.hpp"
#include "common/report.hpp"
#include "common/start.hpp"

namespace cambium::pose_solver {
namespace {

/// Iterations before two starts are compared: by then the cost shows to which minimum each leads.
constexpr int head_start = 5;

/// Minimisation never climbs, but it may fail; then the given poses stand.
void keep_the_better(const PoseGraph& graph, const Weights& weights, const Loss& loss,
                     Minimum& minimum) {
  const double before = robust_cost(graph, graph.T_map_node, weights, loss);
  const double after = robust_cost(graph, minimum.T_map_node, weights, loss);
  if (!(after <= before)) minimum.T_map_node = graph.T_map_node;
  minimum.message += fmt::format("; F {:.6g} -> {:.6g}", before, std::min(after, before));
}

GncResult minimise(const Settings& settings, Minimizer& minimizer, const PoseGraph& graph,
                   const Poses& start, const Loss& loss, const Context& context) {
  if (settings.gnc())
    return graduate(minimizer, graph, start, settings.loss_width, settings.limits, context);
  const Weights weights = unit_weights(graph);
  return {minimizer.run(start, weights, loss, settings.limits, context), weights};
}

/// `loss` decides what is cheap. Iterations spent are added to `iterations`.
Poses find_start(const Settings& settings, Minimizer& minimizer, const Problem& problem,
                 const Loss& loss, const Context& context, int& iterations) {
  const Poses& given = problem.graph.T_map_node;
  if (settings.initialization == "local") return given;
  auto candidates = chordal_starts(problem, loss);
  candidates.insert(candidates.begin(), given);
  if (candidates.size() == 1) return given;
  if (settings.initialization == "chordal") return cheapest(problem, candidates, loss);

  const Poses relaxed = cheapest(problem, {candidates.begin() + 1, candidates.end()}, loss);
  const Limits few{std::min(head_start, settings.limits.iterations), settings.limits.tolerance};
  candidates = {given, relaxed};
  for (Poses& poses : candidates) {
    const Minimum m = minimizer.run(poses, unit_weights(problem.graph), loss, few, context);
    poses = m.T_map_node;
    iterations += m.iterations;
  }
  return cheapest(problem, candidates, loss);
}

/// A minimum of the problem's cost, and what it says of itself.
struct Run {
  Minimum minimum;
  Weights weights;
  double solver_cost = 0;
};

Run run(const Settings& settings, const Problem& problem, const Loss& loss, const Context& context,
        const MakeMinimizer& make) {
  const auto& graph = problem.graph;
  const auto minimizer = make(problem);
  int iterations = 0;
  const Poses start = find_start(settings, *minimizer, problem,
                                 settings.gnc() ? Loss(LossKind::dcs, settings.loss_width) : loss,
                                 context, iterations);
  auto [minimum, weights] = minimise(settings, *minimizer, graph, start, loss, context);
  const double solver_cost = minimum.cost;
  minimum.iterations += iterations;
  keep_the_better(graph, weights, loss, minimum);
  for (std::size_t i = 0; i < problem.held.size(); ++i)  // to the last bit
    if (problem.held[i]) minimum.T_map_node[i] = graph.T_map_node[i];
  return {std::move(minimum), std::move(weights), solver_cost};
}

/// Weighs odometry anew by the loops and solves again, until the sigmas stand still.
Run calibrated(Settings settings, Problem& problem, Run found, const Loss& loss,
               const Context& context, const MakeMinimizer& make,
               std::vector<OdometryGroup>& groups) {
  constexpr int rounds = 30;
  constexpr double still = 1.02;      // a sigma that changes by less is known
  settings.initialization = "local";  // the minimum that was found is followed
  groups = odometry_groups(problem.graph);
  for (int i = 0; i < rounds; ++i) {
    const double change = calibrate(problem, found.minimum.T_map_node, found.weights, loss, groups);
    problem.graph.T_map_node = found.minimum.T_map_node;
    const int iterations = found.minimum.iterations;
    found = run(settings, problem, loss, context, make);
    found.minimum.iterations += iterations;
    if (change < still) break;
  }
  return found;
}

}  // namespace

Solution solve(const Settings& settings, const PoseGraph& given, const Context& context,
               const MakeMinimizer& make) {
  const OneThread one_thread;
  Problem problem(given, context);
  const Loss loss = settings.gnc() ? Loss() : Loss(loss_from(settings.loss), settings.loss_width);
  context.check_cancelled();
  Run found = run(settings, problem, loss, context, make);
  std::vector<OdometryGroup> groups;
  if (settings.calibrates())
    found = calibrated(settings, problem, std::move(found), loss, context, make, groups);

  Solution out;
  out.T_map_node = std::move(found.minimum.T_map_node);
  out.iterations = found.minimum.iterations;
  out.converged = found.minimum.converged;
  out.message = std::move(found.minimum.message);
  out.weight = final_weights(problem.graph, out.T_map_node, found.weights, loss);
  report_odometry(groups, problem.graph, context, out);
  if (settings.diagnostics || !given.marginals.empty())
    report_equations(problem, found.weights, loss, settings.diagnostics, out);
  if (settings.diagnostics) out.scores.emplace_back("solver_cost", found.solver_cost);
  if (settings.certify) report_certificate(problem.graph, found.weights, loss, context, out);
  return out;
}

}  // namespace cambium::pose_solver
