// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "matrix/plot_parts.hpp"
#include "matrix/plots.hpp"

namespace cambium::matrix {
namespace {

constexpr double bar_height = 18;  // pixels

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
  std::string inside = svg_text(label + 10, 14, "start", axis_title(results, metric));
  double y = 24;
  for (const Point& b : bars) {
    const double length = longest > 0 ? std::abs(b.x) / longest * plot_width : 0;
    inside += svg_text(label, y + 13, "end", b.label);
    inside += fmt::format(
        "<rect class=\"{}\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" "
        "height=\"{:.0f}\"/>",
        b.bad ? "bad" : "good", label + 10, y, length, bar_height - 4);
    inside += svg_text(label + 14 + length, y + 13, "start", fmt::format("{:.4g}", b.x));
    y += bar_height;
  }
  return svg(label + plot_width + 100, y + 6, inside);
}

}  // namespace cambium::matrix
