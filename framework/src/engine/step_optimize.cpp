// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "engine/marginals.hpp"
#include "engine/relaxation.hpp"

namespace cambium {
namespace {

void keep_stage(const std::string& step, Atlas& atlas) {
  Stage& stage = atlas.stages.emplace_back();
  stage.step = step;
  for (const MissionState& state : atlas.missions) {
    stage.T_map_node.push_back(state.T_map_node);
    stage.islands.push_back(state.island);
  }
}

}  // namespace

Known run_optimize(Known known, const StepScope& scope) {
  Atlas& atlas = known.atlas;
  const auto warn = [&](const std::string& text) {
    scope.engine.progress().log(LogLevel::warning, text);
  };
  auto graphs = relaxation_graphs(atlas, scope.step.keys, warn);
  ask_for_marginals(atlas, scope.step.keys.marginals, graphs);

  std::vector<Solution> solutions(graphs.size());
  scope.run_items(graphs.size(), [&](std::size_t i) {
    Making making;
    solutions[i] = relax(graphs[i], scope, making);
    return making;
  });

  double before = 0, after = 0;
  for (std::size_t i = 0; i < graphs.size(); ++i) {
    before += cost(graphs[i].graph, graphs[i].graph.T_map_node);
    after += cost(graphs[i].graph, solutions[i].T_map_node, solutions[i].weight);
    scope.record.figures.emplace_back(fmt::format("island_{}.iterations", i),
                                      solutions[i].iterations);
    for (const auto& [name, value] : solutions[i].scores)
      scope.record.figures.emplace_back(fmt::format("island_{}.{}", i, name), value);
    for (auto& figure : marginal_figures(atlas, graphs[i], solutions[i]))
      scope.record.figures.push_back(std::move(figure));
    if (!solutions[i].converged)
      warn(fmt::format("island {}: the solver did not converge: {}", i, solutions[i].message));
    place(solutions[i], graphs[i], atlas);
  }
  keep_stage(scope.step.plugin, atlas);
  known.relaxed_by = &scope.step;
  scope.record.figures.emplace_back("cost.before", before);
  scope.record.figures.emplace_back("cost.after", after);
  scope.record.summary =
      fmt::format("{} island(s), F {:.6g} -> {:.6g}", graphs.size(), before, after);
  return known;
}

}  // namespace cambium
