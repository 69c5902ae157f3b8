// SPDX-License-Identifier: BSD-3-Clause
// What the cells of a matrix gave, and what was found when it was judged.
#pragma once
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "cambium/kinds.hpp"
#include "cambium/statistics.hpp"
#include "engine/report.hpp"

namespace cambium::matrix {

enum class Status { ok, failed, crashed, timed_out, absent };
const char* to_string(Status status);

/// One run of a cell, with one seed. Its metrics are those of the evaluators, then "time.work"
/// (what its results took to make, now or when they were made) and "memory.peak".
struct CellRun {
  std::uint64_t seed = 0;
  Status status = Status::ok;
  std::string message;  ///< why it is not ok
  double seconds = 0;   ///< of the process; little when the cache holds most of it
  std::vector<Metric> metrics;
};

struct CellResult {
  std::string name;
  std::vector<std::pair<std::string, std::string>> choices;  ///< as in Cell
  std::vector<CellRun> runs;

  Status status() const;  ///< of the first run that is not ok
  std::string message() const;
  std::string dataset() const { return choices.back().second; }
  /// Of a metric in all runs that are ok, in order.
  std::vector<double> values(const std::string& metric) const;
};

struct Finding {
  enum class Kind { failure, expectation, regression, improvement, note };
  Kind kind = Kind::note;
  std::string cell, metric, text;
  bool bad() const { return kind < Kind::improvement; }
};
const char* to_string(Finding::Kind kind);

struct Results {
  std::string title;  ///< the file that was run, without its folder
  std::vector<CellResult> cells;
  std::vector<Finding> findings;
  std::vector<std::string> metrics;  ///< the columns of tables

  bool passed() const;
};

/// A metric as it was declared by the first cell that has it; null when none has.
const Metric* find_metric(const std::vector<CellResult>& cells, const std::string& name);
std::vector<std::string> metric_names(
    const std::vector<CellResult>& cells);  ///< in order of appearance
/// In order of appearance.
std::vector<std::string> dataset_names(const std::vector<CellResult>& cells);

Json to_json(const Results& results);
/// Reads results.json, or that of the folder. Throws Error(data).
Results read_results(const std::filesystem::path& path);

}  // namespace cambium::matrix
