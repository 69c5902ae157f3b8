// SPDX-License-Identifier: BSD-3-Clause
#include "matrix/judge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "matrix/selection.hpp"
#include "matrix/tolerance.hpp"

namespace cambium::matrix {
namespace {

using Kind = Finding::Kind;

void check_failure(const CellResult& cell, std::vector<Finding>& out) {
  const Status status = cell.status();
  if (status == Status::absent)
    out.push_back({Kind::note, cell.name, "", cell.message()});
  else if (status != Status::ok)
    out.push_back(
        {Kind::failure, cell.name, "", fmt::format("{}: {}", to_string(status), cell.message())});
}

void check_expectation(const Expectation& e, const CellResult& cell, std::vector<Finding>& out) {
  if (!selects(e.where, cell.choices)) return;
  const double value = median(cell.values(e.metric));
  if (value >= e.at_least && value <= e.at_most) return;
  std::string expected;
  if (std::isfinite(e.at_least)) expected = fmt::format("at least {}", e.at_least);
  if (std::isfinite(e.at_most))
    expected += fmt::format("{}at most {}", expected.empty() ? "" : " and ", e.at_most);
  out.push_back({Kind::expectation, cell.name, e.metric,
                 std::isnan(value) ? fmt::format("expected {}, but no evaluator gave it", expected)
                                   : fmt::format("expected {}, found {:.6g}", expected, value)});
}

// Positive: worse, in the direction of the metric. One without a direction gets worse either way.
double loss(const Metric& metric, double before, double now) {
  switch (metric.better) {
    case Better::lower:
      return now - before;
    case Better::higher:
      return before - now;
    case Better::neither:
      break;
  }
  return std::abs(now - before);
}

void compare_metric(const Spec& spec, const CellResult& cell, const std::string& name,
                    double before, std::vector<Finding>& out) {
  const auto tolerance = tolerance_for(spec, name);
  if (!tolerance) return;
  const double now = median(cell.values(name));
  const Metric* metric = find_metric({cell}, name);
  if (!metric || std::isnan(now)) {
    out.push_back({Kind::regression, cell.name, name,
                   fmt::format("was {:.6g}, is no longer measured", before)});
    return;
  }
  const double allowed = std::max(tolerance->absolute, tolerance->relative * std::abs(before));
  const double worse = loss(*metric, before, now);
  const std::string text =
      fmt::format("{:.6g} -> {:.6g} {} ({:.3g} allowed)", before, now, metric->unit, allowed);
  if (worse > allowed) out.push_back({Kind::regression, cell.name, name, text});
  if (worse < -allowed) out.push_back({Kind::improvement, cell.name, name, text});
}

void compare_cell(const Spec& spec, const CellResult& cell, const Baseline& baseline,
                  std::vector<Finding>& out) {
  const auto before = baseline.find(cell.name);
  if (before == baseline.end()) {
    out.push_back({Kind::note, cell.name, "", "not in the baseline"});
    return;
  }
  for (const auto& [name, value] : before->second) compare_metric(spec, cell, name, value, out);
}

}  // namespace

std::optional<Tolerance> tolerance_for(const Spec& spec, const std::string& metric) {
  const bool of_machine = fits("time.*", metric) || fits("memory.*", metric);
  for (const Tolerance& t : spec.tolerances)
    if (fits(t.pattern, metric) && !(of_machine && t.pattern == "*")) return t;
  if (of_machine) return std::nullopt;
  return Tolerance{};
}

std::vector<Finding> judge(const Spec& spec, const std::vector<CellResult>& cells,
                           const Baseline* baseline) {
  std::vector<Finding> out;
  for (const CellResult& cell : cells) check_failure(cell, out);
  for (const CellResult& cell : cells)
    for (const Expectation& e : spec.expect)
      if (cell.status() == Status::ok) check_expectation(e, cell, out);
  for (const CellResult& cell : cells)
    if (baseline && cell.status() == Status::ok) compare_cell(spec, cell, *baseline, out);
  for (const auto& [name, metrics] : baseline ? *baseline : Baseline{})
    if (std::none_of(cells.begin(), cells.end(),
                     [&](const CellResult& c) { return c.name == name; }))
      out.push_back({Kind::note, name, "", "in the baseline, but no cell of the matrix"});
  std::stable_sort(out.begin(), out.end(),
                   [](const Finding& a, const Finding& b) { return a.kind < b.kind; });
  return out;
}

}  // namespace cambium::matrix
