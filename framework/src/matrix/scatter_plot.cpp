// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "matrix/plot_parts.hpp"
#include "matrix/plots.hpp"
#include "matrix/table.hpp"

namespace cambium::matrix {
namespace {

constexpr double plot_height = 260, margin = 60;  // pixels

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
    inside += svg_text(at_x(x), plot_height + 26, "middle", fmt::format("{:.3g}", x));
    inside += svg_text(margin - 6, at_y(y) + 4, "end", fmt::format("{:.3g}", y));
  }
  for (const Point& p : all)
    inside += fmt::format(
                  "<circle class=\"{}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4\"><title>{}: "
                  "{:.4g}, {:.4g}</title></circle>",
                  p.bad ? "bad" : "good", at_x(p.x), at_y(p.y), escaped(p.label), p.x, p.y) +
              svg_text(at_x(p.x) + 7, at_y(p.y) + 4, "start", p.label);
  inside += svg_text(margin + plot_width / 2, plot_height + 44, "middle",
                     axis_title(results, metric) + " against " + axis_title(results, time));
  return svg(margin + plot_width + 220, plot_height + 54, inside);
}

}  // namespace cambium::matrix
