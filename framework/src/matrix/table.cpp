// SPDX-License-Identifier: BSD-3-Clause
#include "matrix/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace cambium::matrix {
namespace {

const char* arrow(Better better) {
  return better == Better::lower ? " \u2193" : better == Better::higher ? " \u2191" : "";
}

std::string title(const Metric* metric, const std::string& name) {
  if (!metric) return name;
  const std::string unit =
      metric->unit.empty() || metric->unit == "1" ? "" : fmt::format(" [{}]", metric->unit);
  return name + unit + arrow(metric->better);
}

// The median; with several runs also half of the span that they cover.
std::string shown(const std::vector<double>& values) {
  const double value = median(values);
  if (std::isnan(value)) return "-";
  if (values.size() < 2) return fmt::format("{:.4g}", value);
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return fmt::format("{:.4g} \u00b1 {:.2g}", value, (*high - *low) / 2);
}

// The best median of each dataset; several cells may share it.
void mark_best(const Results& results, const std::string& name, std::size_t column, Table& table) {
  const Metric* metric = find_metric(results.cells, name);
  if (!metric || metric->better == Better::neither) return;
  const double sign = metric->better == Better::lower ? 1 : -1;
  std::map<std::string, double> best;
  for (const CellResult& cell : results.cells) {
    const double value = sign * median(cell.values(name));
    const auto [it, fresh] = best.emplace(cell.dataset(), value);
    if (!fresh && !(it->second <= value)) it->second = value;
  }
  for (std::size_t i = 0; i < results.cells.size(); ++i)
    table.rows[i].entries[column].best =
        sign * median(results.cells[i].values(name)) == best[results.cells[i].dataset()];
}

}  // namespace

Table make_table(const Results& results) {
  Table table;
  for (const CellResult& cell : results.cells) {
    TableRow& row = table.rows.emplace_back();
    row.name = cell.name;
    row.status = cell.status();
    for (const std::string& metric : results.metrics)
      row.entries.push_back({shown(cell.values(metric)), false, false});
    for (const Finding& f : results.findings) {
      if (f.cell != cell.name || !f.bad()) continue;
      row.bad = true;
      const auto at = std::find(results.metrics.begin(), results.metrics.end(), f.metric);
      if (at != results.metrics.end())
        row.entries[std::size_t(at - results.metrics.begin())].bad = true;
    }
  }
  for (std::size_t i = 0; i < results.metrics.size(); ++i) {
    const std::string& name = results.metrics[i];
    table.columns.push_back(title(find_metric(results.cells, name), name));
    mark_best(results, name, i, table);
  }
  return table;
}

std::string verdict(const Results& results) {
  std::map<Finding::Kind, int> counts;
  for (const Finding& f : results.findings) ++counts[f.kind];
  std::string out;
  for (const auto& [kind, count] : counts)
    if (kind != Finding::Kind::note)
      out += fmt::format("{}{} {}{}", out.empty() ? "" : ", ", count, to_string(kind),
                         count == 1 ? "" : "s");
  const auto ran = std::count_if(results.cells.begin(), results.cells.end(),
                                 [](const CellResult& c) { return c.status() == Status::ok; });
  return fmt::format("{} of {} cells ran{}{}", ran, results.cells.size(), out.empty() ? "" : "; ",
                     out);
}

}  // namespace cambium::matrix
