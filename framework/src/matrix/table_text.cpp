// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "matrix/table.hpp"

namespace cambium::matrix {
namespace {

// Characters on the screen: bytes that do not continue a UTF-8 sequence.
std::size_t width(const std::string& text) {
  std::size_t n = 0;
  for (const char c : text) n += (static_cast<unsigned char>(c) & 0xC0) != 0x80;
  return n;
}

std::string padded(const std::string& text, std::size_t to, bool right) {
  const std::string space(to > width(text) ? to - width(text) : 0, ' ');
  return right ? space + text : text + space;
}

std::string coloured(const std::string& text, const char* code) {
  return fmt::format("\x1b[{}m{}\x1b[0m", code, text);
}

std::string entry_text(const TableEntry& e, std::size_t to, bool colour) {
  const std::string text = padded(e.text, to, true);
  if (!colour) return text + (e.bad ? "!" : e.best ? "*" : " ");
  if (e.bad) return coloured(text, "31") + " ";
  return (e.best ? coloured(text, "1") : text) + " ";
}

}  // namespace

std::string table_text(const Table& table, bool colour) {
  std::size_t first = 4;
  std::vector<std::size_t> widths;
  for (const TableRow& row : table.rows) first = std::max(first, width(row.name));
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    widths.push_back(width(table.columns[c]));
    for (const TableRow& row : table.rows)
      widths[c] = std::max(widths[c], width(row.entries[c].text));
  }
  std::string out = padded("cell", first, false) + "  " + padded("status", 9, false);
  for (std::size_t c = 0; c < widths.size(); ++c)
    out += "  " + padded(table.columns[c], widths[c], true) + " ";
  out += "\n";
  for (const TableRow& row : table.rows) {
    const std::string status = padded(to_string(row.status), 9, false);
    const bool failed = row.status != Status::ok && row.status != Status::absent;
    out += padded(row.name, first, false) + "  " +
           (colour && failed ? coloured(status, "31") : status);
    for (std::size_t c = 0; c < widths.size(); ++c)
      out += "  " + entry_text(row.entries[c], widths[c], colour);
    out += "\n";
  }
  return out;
}

std::string findings_text(const Results& results, bool colour) {
  std::string out;
  for (const Finding& f : results.findings) {
    const std::string kind = padded(to_string(f.kind), 11, false);
    out += fmt::format("{}  {}{}{}: {}\n", colour && f.bad() ? coloured(kind, "31") : kind, f.cell,
                       f.metric.empty() ? "" : " ", f.metric, f.text);
  }
  return out;
}

}  // namespace cambium::matrix
