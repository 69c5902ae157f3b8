// SPDX-License-Identifier: BSD-3-Clause
#include "matrix/cells.hpp"

#include <algorithm>
#include <set>

#include "matrix/selection.hpp"

namespace cambium::matrix {
namespace {

void apply(const Axis& axis, const Choice& choice, Pipeline& pipeline) {
  int count = 0;
  for (StepSpec& step : pipeline.steps) {
    if (step.verb != axis.verb || (++count != axis.only && axis.only != 0)) continue;
    if (step.plugin == choice.plugin) {
      step.params = merged(step.params, choice.params);
      continue;
    }
    // Another plugin knows nothing of the parameters of this one.
    step.plugin = choice.plugin;
    step.plugin_where = step.where = choice.where;
    step.params = choice.params;
    step.platform_params.clear();
  }
}

// Each value once, not each combination: a mistake is told once.
void check_choices(const Spec& spec, const Registry& registry) {
  Diagnostics diagnostics;
  std::set<std::string> told;
  const auto check = [&](const Pipeline& pipeline) {
    try {
      resolve(pipeline, registry);
    } catch (const Error& e) {
      if (told.insert(e.what()).second) diagnostics.add(e.where(), e.message());
    }
  };
  check(spec.base);
  diagnostics.throw_if_any();
  for (const Axis& axis : spec.axes)
    for (const Choice& choice : axis.choices) {
      Pipeline pipeline = spec.base;
      apply(axis, choice, pipeline);
      check(pipeline);
    }
  diagnostics.throw_if_any();
}

// The combination with the given number, the last axis running fastest.
Cell make_cell(const Spec& spec, const Dataset& dataset, std::size_t number,
               const Registry& registry) {
  Cell cell;
  Pipeline pipeline = spec.base;
  for (std::size_t a = spec.axes.size(); a-- > 0;) {
    const Axis& axis = spec.axes[a];
    const Choice& choice = axis.choices[number % axis.choices.size()];
    number /= axis.choices.size();
    apply(axis, choice, pipeline);
    cell.name = choice.name + (cell.name.empty() ? "" : "+" + cell.name);
    cell.choices.insert(cell.choices.begin(), {axis.name, choice.name});
  }
  cell.name = cell.name.empty() ? dataset.name : cell.name + "@" + dataset.name;
  cell.choices.emplace_back("dataset", dataset.name);
  cell.pipeline = resolve(pipeline, registry);
  return cell;
}

}  // namespace

std::vector<Cell> make_cells(const Spec& spec, const Registry& registry) {
  check_choices(spec, registry);
  std::size_t combinations = 1;
  for (const Axis& axis : spec.axes) combinations *= axis.choices.size();
  std::vector<Cell> cells;
  for (const Dataset& dataset : spec.datasets)
    for (std::size_t i = 0; i < combinations; ++i) {
      Cell cell = make_cell(spec, dataset, i, registry);
      const bool excluded =
          std::any_of(spec.exclude.begin(), spec.exclude.end(),
                      [&](const Selection& s) { return selects(s, cell.choices); });
      if (!excluded) cells.push_back(std::move(cell));
    }
  if (cells.empty()) throw Error(ErrorCode::config, spec.file.string(), "'exclude' leaves no cell");
  return cells;
}

}  // namespace cambium::matrix
