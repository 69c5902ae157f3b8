// SPDX-License-Identifier: BSD-3-Clause
#include "matrix/plot_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "matrix/table.hpp"

namespace cambium::matrix {
namespace {

std::string label_of(const CellResult& cell) { return cell.name.substr(0, cell.name.find('@')); }

bool is_bad(const Results& results, const std::string& cell) {
  return std::any_of(results.findings.begin(), results.findings.end(),
                     [&](const Finding& f) { return f.cell == cell && f.bad(); });
}

}  // namespace

std::vector<Point> points(const Results& results, const std::string& dataset, const std::string& x,
                          const std::string& y) {
  std::vector<Point> out;
  for (const CellResult& cell : results.cells) {
    if (cell.dataset() != dataset) continue;
    const Point p{label_of(cell), median(cell.values(x)), median(cell.values(y)),
                  is_bad(results, cell.name)};
    if (std::isfinite(p.x) && std::isfinite(p.y)) out.push_back(p);
  }
  return out;
}

std::string svg_text(double x, double y, const char* anchor, const std::string& what) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>", x, y, anchor,
                     escaped(what));
}

std::string axis_title(const Results& results, const std::string& metric) {
  const Metric* m = find_metric(results.cells, metric);
  return m && !m->unit.empty() ? fmt::format("{} [{}]", metric, m->unit) : metric;
}

std::string svg(double width, double height, const std::string& inside) {
  return fmt::format(
      "<svg width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} {1:.0f}\" "
      "role=\"img\">{2}</svg>\n",
      width, height, inside);
}

}  // namespace cambium::matrix
