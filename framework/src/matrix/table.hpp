// SPDX-License-Identifier: BSD-3-Clause
// Results as a table: one row a cell, one column a metric.
#pragma once
#include "matrix/results.hpp"

namespace cambium::matrix {

struct TableEntry {
  std::string text;
  bool best = false;  ///< of the cells of its dataset
  bool bad = false;   ///< a finding says so
};

struct TableRow {
  std::string name;  ///< of the cell
  Status status = Status::ok;
  bool bad = false;
  std::vector<TableEntry> entries;  ///< one a column
};

struct Table {
  std::vector<std::string> columns;  ///< metrics with their unit and direction
  std::vector<TableRow> rows;
};

Table make_table(const Results& results);

/// For people: aligned; best in bold and bad in red when `colour`.
std::string table_text(const Table& table, bool colour);
/// "2 regressions, 1 failure" or "all 12 cells passed".
std::string verdict(const Results& results);
std::string findings_text(const Results& results, bool colour);

std::string markdown(const Results& results);
std::string junit_xml(const Results& results);
/// One page without anything from elsewhere: table, findings, plots as inline SVG.
std::string html(const Results& results);

/// Text that is safe between the tags and in the attributes of XML and HTML.
std::string escaped(const std::string& text);

}  // namespace cambium::matrix
