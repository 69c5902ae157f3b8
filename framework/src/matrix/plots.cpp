// SPDX-License-Identifier: BSD-3-Clause
#include "matrix/plots.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "matrix/table.hpp"

namespace cambium::matrix {
namespace {

struct Point {
  std::string label;
  double x = 0, y = 0;
  bool bad = false;
};

// Pixels. Labels of cells stand left of the bars; 7 pixels a character of the font at 12.
constexpr double bar_height = 18, plot_width = 420, plot_height = 260, margin = 60;

std::string label_of(const CellResult& cell) { return cell.name.substr(0, cell.name.find('@')); }

bool is_bad(const Results& results, const std::string& cell) {
  return std::any_of(results.findings.begin(), results.findings.end(),
                     [&](const Finding& f) { return f.cell == cell && f.bad(); });
}

// Of the cells of the dataset that have both metrics.
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

std::string text(double x, double y, const char* anchor, const std::string& what) {
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

// A range that leaves the outermost points off the frame.
std::pair<double, double> padded_range(const std::vector<Point>& all, double Point::*value) {
  const auto [low, high] = std::minmax_element(
      all.begin(), all.end(), [&](const Point& a, const Point& b) { return a.*value < b.*value; });
  const double lowest = (*low).*value, highest = (*high).*value;
  const double pad =
      highest > lowest ? 0.08 * (highest - lowest) : std::max(std::abs(highest), 1.0) * 0.1;
  return {lowest - pad, highest + pad};
}

}  // namespace

std::string bar_plot(const Results& results, const std::string& dataset,
                     const std::string& metric) {
  const auto bars = points(results, dataset, metric, metric);
  if (bars.empty()) return {};
  double longest = 0, label = 0;
  for (const Point& b : bars) {
    longest = std::max(longest, std::abs(b.x));
    label = std::max(label, 7.0 * double(b.label.size()));
  }
  std::string inside = text(label + 10, 14, "start", axis_title(results, metric));
  double y = 24;
  for (const Point& b : bars) {
    const double length = longest > 0 ? std::abs(b.x) / longest * plot_width : 0;
    inside += text(label, y + 13, "end", b.label);
    inside += fmt::format(
        "<rect class=\"{}\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" "
        "height=\"{:.0f}\"/>",
        b.bad ? "bad" : "good", label + 10, y, length, bar_height - 4);
    inside += text(label + 14 + length, y + 13, "start", fmt::format("{:.4g}", b.x));
    y += bar_height;
  }
  return svg(label + plot_width + 100, y + 6, inside);
}

std::string scatter_plot(const Results& results, const std::string& dataset,
                         const std::string& time, const std::string& metric) {
  const auto all = points(results, dataset, time, metric);
  if (all.empty()) return {};
  const auto [left, right] = padded_range(all, &Point::x);
  const auto [bottom, top] = padded_range(all, &Point::y);
  const auto at_x = [l = left, r = right](double v) {
    return margin + (v - l) / (r - l) * plot_width;
  };
  const auto at_y = [b = bottom, t = top](double v) {
    return 10 + (t - v) / (t - b) * plot_height;
  };
  std::string inside = fmt::format(
      "<rect class=\"frame\" x=\"{}\" y=\"10\" width=\"{}\" "
      "height=\"{}\"/>",
      margin, plot_width, plot_height);
  for (const double part : {0.1, 0.5, 0.9}) {
    const double x = left + part * (right - left), y = bottom + part * (top - bottom);
    inside += text(at_x(x), plot_height + 26, "middle", fmt::format("{:.3g}", x));
    inside += text(margin - 6, at_y(y) + 4, "end", fmt::format("{:.3g}", y));
  }
  for (const Point& p : all)
    inside += fmt::format(
                  "<circle class=\"{}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4\"><title>{}: "
                  "{:.4g}, {:.4g}</title></circle>",
                  p.bad ? "bad" : "good", at_x(p.x), at_y(p.y), escaped(p.label), p.x, p.y) +
              text(at_x(p.x) + 7, at_y(p.y) + 4, "start", p.label);
  inside += text(margin + plot_width / 2, plot_height + 44, "middle",
                 axis_title(results, time) + " against " + axis_title(results, metric));
  return svg(margin + plot_width + 220, plot_height + 54, inside);
}

}  // namespace cambium::matrix
