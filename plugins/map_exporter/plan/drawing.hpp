// SPDX-License-Identifier: BSD-3-Clause
// The little of SVG that a plan needs.
#pragma once
#include <string>
#include <vector>

#include "cambium/se3.hpp"

namespace plan {

struct Box {
  double x_min = 0, x_max = 0, y_min = 0, y_max = 0;  ///< map frame [m]
  void include(const cambium::Vec3& p);
  bool empty = true;
};

/// Draws map coordinates (x right, y up, metres) into a picture `width` pixels wide.
class Drawing {
 public:
  Drawing(const Box& box, int width);

  void line(const cambium::Vec3& a, const cambium::Vec3& b, const std::string& colour,
            double stroke);
  void path(const std::vector<cambium::Vec3>& points, const std::string& colour, double stroke,
            bool dashed);
  void dot(const cambium::Vec3& p, const std::string& colour, double radius);
  void legend(const std::string& text, const std::string& colour);  ///< one row below the last
  void scale_bar();
  std::string svg() const;

 private:
  double x(const cambium::Vec3& p) const { return margin + (p.x() - box_.x_min) * scale_; }
  double y(const cambium::Vec3& p) const { return margin + (box_.y_max - p.y()) * scale_; }
  static constexpr double margin = 20, row = 18;

  Box box_;
  int width_;
  double scale_, height_;  // pixels a metre; pixels
  int rows_ = 0;
  std::string body_;
};

/// Escapes what XML reserves.
std::string escaped(const std::string& text);

}  // namespace plan
