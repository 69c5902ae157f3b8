// SPDX-License-Identifier: BSD-3-Clause
// A comma-separated table whose first line names the columns.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cambium/mission.hpp"

namespace cambium {

class CsvTable {
 public:
  /// Throws Error(data, file:line) unless every row has as many fields as the header.
  explicit CsvTable(const std::filesystem::path& path);

  const std::vector<std::string>& columns() const { return header_; }  ///< in their order
  std::size_t rows() const { return rows_.size(); }
  /// Throws when a column is unknown: a misspelt one would be ignored otherwise.
  void allow_only(const std::vector<std::string>& columns) const;
  bool has(std::string_view column) const { return find(column).has_value(); }
  void require(const std::vector<std::string>& columns) const;

  const std::string& text(std::size_t row, std::string_view column) const;
  double number(std::size_t row, std::string_view column) const;         ///< finite, or an error
  std::int64_t integer(std::size_t row, std::string_view column) const;  ///< not negative
  [[noreturn]] void fail(std::size_t row, const std::string& message) const;

 private:
  struct Row {
    int line = 0;
    std::vector<std::string> fields;
  };
  std::optional<std::size_t> find(std::string_view column) const;

  std::filesystem::path path_;
  int header_line_ = 0;
  std::vector<std::string> header_;
  std::vector<Row> rows_;
};

}  // namespace cambium
