// SPDX-License-Identifier: BSD-3-Clause
// What the plots share.
#pragma once
#include "matrix/results.hpp"

namespace cambium::matrix {

struct Point {
  std::string label;  ///< of the cell, without its dataset
  double x = 0, y = 0;
  bool bad = false;  ///< a finding says so
};

/// Of the cells of the dataset that have both metrics.
std::vector<Point> points(const Results& results, const std::string& dataset, const std::string& x,
                          const std::string& y);

constexpr double plot_width = 420;  ///< pixels

std::string svg_text(double x, double y, const char* anchor, const std::string& what);
std::string svg(double width, double height, const std::string& inside);
std::string axis_title(const Results& results, const std::string& metric);

}  // namespace cambium::matrix
