// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "matrix/table.hpp"

namespace cambium::matrix {
namespace {

std::string in_table(std::string text) {
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2)
    text.insert(at, "\\");
  return text;
}

}  // namespace

std::string markdown(const Results& results) {
  const Table table = make_table(results);
  std::string out = fmt::format("# {}\n\n{}. Best of a dataset in bold.\n\n| cell | status |",
                                results.title, verdict(results));
  for (const auto& c : table.columns) out += fmt::format(" {} |", in_table(c));
  out += "\n|---|---|";
  for (std::size_t i = 0; i < table.columns.size(); ++i) out += "---:|";
  for (const TableRow& row : table.rows) {
    out += fmt::format("\n| {} | {} |", in_table(row.name), to_string(row.status));
    for (const TableEntry& e : row.entries)
      out += fmt::format(" {0}{1}{0}{2} |", e.best ? "**" : "", e.text, e.bad ? " (!)" : "");
  }
  out += "\n";
  if (!results.findings.empty()) out += "\n";
  for (const Finding& f : results.findings)
    out += fmt::format("- {}**{}**{} {}: {}\n", f.bad() ? "" : "(", to_string(f.kind),
                       f.bad() ? "" : ")", f.cell + (f.metric.empty() ? "" : " `" + f.metric + "`"),
                       f.text);
  return out;
}

}  // namespace cambium::matrix
