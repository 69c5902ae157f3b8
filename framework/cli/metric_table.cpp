// SPDX-License-Identifier: BSD-3-Clause
#include "metric_table.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace cambium::cli {
namespace {

const Metric* find(const std::vector<StepRecord>& steps, const std::string& label,
                   const std::string& name) {
  for (const auto& step : steps)
    for (const auto& m : step.metrics)
      if (step.label == label && m.name == name) return &m;
  return nullptr;
}

struct Row {
  std::string plugin, name, unit;
};

// An evaluator that ran several times gives the first metric of its last time: before anything is
// tied some have nothing to measure yet.
std::vector<Row> rows_of(const std::vector<StepRecord>& steps) {
  std::vector<Row> rows;
  for (const auto& step : steps) {
    if (step.metrics.empty()) continue;
    const Row row{step.plugin, step.metrics.front().name, step.metrics.front().unit};
    const auto known = std::find_if(rows.begin(), rows.end(),
                                    [&](const Row& r) { return r.plugin == step.plugin; });
    if (known == rows.end())
      rows.push_back(row);
    else
      *known = row;
  }
  return rows;
}

std::vector<std::string> labels_of(const std::vector<StepRecord>& steps) {
  std::vector<std::string> labels;
  for (const auto& step : steps)
    if (!step.metrics.empty() && std::ranges::find(labels, step.label) == labels.end())
      labels.push_back(step.label);
  return labels;
}

}  // namespace

std::string headline_table(const std::vector<StepRecord>& steps) {
  const auto rows = rows_of(steps);
  const auto labels = labels_of(steps);
  std::size_t width = 0;
  for (const Row& row : rows) width = std::max(width, row.name.size());
  std::string out;
  if (labels.size() > 1) {
    out += fmt::format("{:<{}}", "", width);
    for (const auto& label : labels) out += fmt::format("  {:>10}", label);
    out += "\n";
  }
  for (const Row& row : rows) {
    out += fmt::format("{:<{}}", row.name, width);
    for (const auto& label : labels) {
      const Metric* m = find(steps, label, row.name);
      out += m ? fmt::format("  {:>10.4g}", m->value) : fmt::format("  {:>10}", "-");
    }
    out += fmt::format(" {}\n", row.unit);
  }
  return out;
}

std::string full_table(const std::vector<StepRecord>& steps) {
  std::size_t width = 0;
  for (const auto& step : steps)
    for (const auto& m : step.metrics) width = std::max(width, m.name.size());
  std::string out;
  for (const auto& step : steps)
    for (const auto& m : step.metrics)
      out += fmt::format("{:<{}}  {:>10.4g} {}\n", m.name, width, m.value, m.unit);
  return out;
}

}  // namespace cambium::cli
