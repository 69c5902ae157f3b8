// SPDX-License-Identifier: BSD-3-Clause
#include "matrix/compare.hpp"

#include <algorithm>

#include "matrix/mann_whitney.hpp"

namespace cambium::matrix {
namespace {

using Verdict = Change::Verdict;
constexpr std::size_t enough_runs = 4;  // 4 against 4: the smallest p is 2 / 70 = 0.029

const CellResult* find_cell(const Results& results, const std::string& name) {
  for (const CellResult& cell : results.cells)
    if (cell.name == name) return &cell;
  return nullptr;
}

Verdict judge(const Change& c, double alpha) {
  if (std::min(c.runs_before, c.runs_after) < enough_runs) return Verdict::unknown;
  if (c.p >= alpha) return Verdict::noise;
  if (c.metric.better == Better::neither || c.before == c.after) return Verdict::moved;
  return (c.after < c.before) == (c.metric.better == Better::lower) ? Verdict::better
                                                                    : Verdict::worse;
}

void compare_cell(const CellResult& before, const CellResult& after, double alpha,
                  Comparison& out) {
  for (const std::string& name : metric_names({before})) {
    auto a = before.values(name), b = after.values(name);
    if (a.empty() || b.empty()) continue;
    std::sort(a.begin(), a.end());
    std::sort(b.begin(), b.end());
    if (a == b) {
      ++out.same;
      continue;
    }
    Change c{before.name, *find_metric({before}, name), median(a),       median(b), a.size(),
             b.size(),    mann_whitney_p(a, b),         Verdict::unknown};
    c.verdict = judge(c, alpha);
    out.changes.push_back(std::move(c));
  }
}

}  // namespace

const char* to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::better:
      return "better";
    case Verdict::worse:
      return "worse";
    case Verdict::moved:
      return "moved";
    case Verdict::noise:
      return "noise";
    case Verdict::unknown:
      break;
  }
  return "too few runs to tell";
}

Comparison compare(const Results& before, const Results& after, double alpha) {
  Comparison out;
  for (const CellResult& cell : before.cells) {
    if (const CellResult* other = find_cell(after, cell.name))
      compare_cell(cell, *other, alpha, out);
    else
      out.only_before.push_back(cell.name);
  }
  for (const CellResult& cell : after.cells)
    if (!find_cell(before, cell.name)) out.only_after.push_back(cell.name);
  return out;
}

}  // namespace cambium::matrix
