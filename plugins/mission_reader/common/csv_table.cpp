// SPDX-License-Identifier: BSD-3-Clause
#include "common/csv_table.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "cambium/error.hpp"
#include "cambium/files.hpp"

namespace cambium {
namespace {

std::string_view trimmed(std::string_view text) {
  const auto begin = text.find_first_not_of(" \t\r");
  if (begin == text.npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t\r") - begin + 1);
}

std::vector<std::string> split(std::string_view line) {
  std::vector<std::string> out;
  for (;;) {
    const auto comma = line.find(',');
    out.emplace_back(trimmed(line.substr(0, comma)));
    if (comma == line.npos) return out;
    line.remove_prefix(comma + 1);
  }
}

std::string joined(const std::vector<std::string>& words) {
  std::string out;
  for (const auto& word : words) out += (out.empty() ? "" : ",") + word;
  return out;
}

template <class T>
bool parse(std::string_view text, T& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && end == text.data() + text.size();
}

}  // namespace

CsvTable::CsvTable(const std::filesystem::path& path) : path_(path) {
  const std::string content = read_file(path);
  if (content.find('\0') != content.npos)
    throw Error(ErrorCode::data, path.string(), "is binary, expected a table with commas");
  std::string_view text = content;
  for (int line = 1; !text.empty(); ++line) {
    const auto end = text.find('\n');
    std::string_view row = trimmed(text.substr(0, end));
    text.remove_prefix(end == text.npos ? text.size() : end + 1);
    if (row.empty()) continue;
    if (header_.empty()) {
      if (row[0] == '#') row.remove_prefix(1);
      header_ = split(row);
      header_line_ = line;
    } else if (row[0] != '#') {
      rows_.push_back({line, split(row)});
      if (rows_.back().fields.size() != header_.size())
        fail(rows_.size() - 1, "expected " + std::to_string(header_.size()) +
                                   " fields as in line " + std::to_string(header_line_) +
                                   ", found " + std::to_string(rows_.back().fields.size()));
    }
  }
}

void CsvTable::require(const std::vector<std::string>& columns) const {
  for (const auto& column : columns)
    if (!has(column))
      throw Error(ErrorCode::data, path_.string() + ":" + std::to_string(std::max(1, header_line_)),
                  "found no column '" + column + "', expected the header " + joined(columns));
}

void CsvTable::allow_only(const std::vector<std::string>& columns) const {
  for (const auto& column : header_)
    if (std::find(columns.begin(), columns.end(), column) == columns.end())
      throw Error(
          ErrorCode::data, path_.string() + ":" + std::to_string(header_line_),
          "found column '" + column.substr(0, 40) + "', expected some of " + joined(columns));
}

std::optional<std::size_t> CsvTable::find(std::string_view column) const {
  const auto it = std::find(header_.begin(), header_.end(), column);
  if (it == header_.end()) return std::nullopt;
  return std::size_t(it - header_.begin());
}

const std::string& CsvTable::text(std::size_t row, std::string_view column) const {
  return rows_[row].fields[find(column).value()];
}

double CsvTable::number(std::size_t row, std::string_view column) const {
  double value = 0;
  const std::string& field = text(row, column);
  if (!parse(field, value) || !std::isfinite(value))
    fail(row, "found " + std::string(column) + " '" + field.substr(0, 40) + "', expected a number");
  return value;
}

std::int64_t CsvTable::integer(std::size_t row, std::string_view column) const {
  std::int64_t value = 0;
  const std::string& field = text(row, column);
  if (!parse(field, value) || value < 0)
    fail(row, "found " + std::string(column) + " '" + field.substr(0, 40) +
                  "', expected an integer from 0");
  return value;
}

void CsvTable::fail(std::size_t row, const std::string& message) const {
  throw Error(ErrorCode::data, path_.string() + ":" + std::to_string(rows_[row].line), message);
}

}  // namespace cambium
