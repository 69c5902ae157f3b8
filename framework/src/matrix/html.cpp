// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "matrix/plots.hpp"
#include "matrix/table.hpp"

namespace cambium::matrix {
namespace {

constexpr const char* style =
    "body{font:14px/1.4 system-ui,sans-serif;margin:2em;color:#222}"
    "table{border-collapse:collapse}td,th{padding:.25em .7em;border-bottom:1px solid #ddd;"
    "text-align:right;white-space:nowrap}td:first-child,th:first-child{text-align:left}"
    ".best{font-weight:bold}.worse{color:#c00}.passed{color:#080}"
    "svg{display:block;margin:1em 0;font-size:12px}svg .good{fill:#3a7ca5}svg .bad{fill:#c00}"
    "svg .frame{fill:none;stroke:#999}";

std::string table_html(const Table& table) {
  std::string out = "<table><tr><th>cell</th><th>status</th>";
  for (const auto& c : table.columns) out += fmt::format("<th>{}</th>", escaped(c));
  out += "</tr>\n";
  for (const TableRow& row : table.rows) {
    const bool failed = row.status != Status::ok && row.status != Status::absent;
    out += fmt::format("<tr><td>{}</td><td class=\"{}\">{}</td>", escaped(row.name),
                       failed ? "worse" : "", to_string(row.status));
    for (const TableEntry& e : row.entries)
      out += fmt::format("<td class=\"{}{}\">{}</td>", e.best ? "best " : "", e.bad ? "worse" : "",
                         escaped(e.text));
    out += "</tr>\n";
  }
  return out + "</table>\n";
}

std::string findings_html(const Results& results) {
  if (results.findings.empty()) return {};
  std::string out = "<h2>Findings</h2>\n<ul>\n";
  for (const Finding& f : results.findings)
    out += fmt::format("<li><span class=\"{}\">{}</span> {} <b>{}</b>: {}</li>\n",
                       f.bad() ? "worse" : "", to_string(f.kind), escaped(f.cell),
                       escaped(f.metric), escaped(f.text));
  return out + "</ul>\n";
}

std::string plots_html(const Results& results) {
  std::string out;
  for (const std::string& dataset : dataset_names(results.cells)) {
    out += fmt::format("<h2>{}</h2>\n", escaped(dataset));
    if (!results.metrics.empty())
      out += scatter_plot(results, dataset, "time.work", results.metrics.front());
    for (const std::string& metric : results.metrics) out += bar_plot(results, dataset, metric);
  }
  return out;
}

}  // namespace

std::string html(const Results& results) {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>{0}</title>"
      "<style>{1}</style></head><body>\n<h1>{0}</h1>\n<p class=\"{2}\">{3}</p>\n{4}{5}{6}"
      "</body></html>\n",
      escaped(results.title), style, results.passed() ? "passed" : "worse",
      escaped(verdict(results)), table_html(make_table(results)), findings_html(results),
      plots_html(results));
}

}  // namespace cambium::matrix
