// SPDX-License-Identifier: BSD-3-Clause
#include "matrix/results.hpp"

#include <algorithm>
#include <limits>

namespace cambium::matrix {

const char* to_string(Status status) {
  switch (status) {
    case Status::ok:
      return "ok";
    case Status::failed:
      return "failed";
    case Status::crashed:
      return "crashed";
    case Status::timed_out:
      return "timed out";
    case Status::absent:
      break;
  }
  return "absent";
}

const char* to_string(Finding::Kind kind) {
  switch (kind) {
    case Finding::Kind::failure:
      return "failure";
    case Finding::Kind::expectation:
      return "expectation";
    case Finding::Kind::regression:
      return "regression";
    case Finding::Kind::improvement:
      return "improvement";
    case Finding::Kind::note:
      break;
  }
  return "note";
}

Status CellResult::status() const {
  for (const CellRun& run : runs)
    if (run.status != Status::ok) return run.status;
  return Status::ok;
}

std::string CellResult::message() const {
  for (const CellRun& run : runs)
    if (run.status != Status::ok) return run.message;
  return {};
}

std::vector<double> CellResult::values(const std::string& metric) const {
  std::vector<double> out;
  for (const CellRun& run : runs)
    for (const Metric& m : run.metrics)
      if (run.status == Status::ok && m.name == metric) out.push_back(m.value);
  return out;
}

bool Results::passed() const {
  return std::none_of(findings.begin(), findings.end(), [](const Finding& f) { return f.bad(); });
}

const Metric* find_metric(const std::vector<CellResult>& cells, const std::string& name) {
  for (const CellResult& cell : cells)
    for (const CellRun& run : cell.runs)
      for (const Metric& m : run.metrics)
        if (m.name == name) return &m;
  return nullptr;
}

std::vector<std::string> metric_names(const std::vector<CellResult>& cells) {
  std::vector<std::string> names;
  for (const CellResult& cell : cells)
    for (const CellRun& run : cell.runs)
      for (const Metric& m : run.metrics)
        if (std::find(names.begin(), names.end(), m.name) == names.end()) names.push_back(m.name);
  return names;
}

std::vector<std::string> dataset_names(const std::vector<CellResult>& cells) {
  std::vector<std::string> out;
  for (const CellResult& cell : cells)
    if (std::find(out.begin(), out.end(), cell.dataset()) == out.end())
      out.push_back(cell.dataset());
  return out;
}

}  // namespace cambium::matrix
