// SPDX-License-Identifier: BSD-3-Clause
#include "drawing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace plan {

using cambium::Vec3;

void Box::include(const Vec3& p) {
  x_min = empty ? p.x() : std::min(x_min, p.x());
  x_max = empty ? p.x() : std::max(x_max, p.x());
  y_min = empty ? p.y() : std::min(y_min, p.y());
  y_max = empty ? p.y() : std::max(y_max, p.y());
  empty = false;
}

Drawing::Drawing(const Box& box, int width) : box_(box), width_(width) {
  // A path along one axis still gets a picture of some height.
  const double w = std::max(box.x_max - box.x_min, 1.0), h = std::max(box.y_max - box.y_min, w / 8);
  scale_ = (width - 2 * margin) / w;
  height_ = h * scale_ + 2 * margin;
}

void Drawing::line(const Vec3& a, const Vec3& b, const std::string& colour, double stroke) {
  body_ += fmt::format(
      "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"{}\" "
      "stroke-width=\"{}\"/>\n",
      x(a), y(a), x(b), y(b), colour, stroke);
}

void Drawing::path(const std::vector<Vec3>& points, const std::string& colour, double stroke,
                   bool dashed) {
  std::string list;
  for (const Vec3& p : points) list += fmt::format("{:.1f},{:.1f} ", x(p), y(p));
  body_ +=
      fmt::format("<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\"{}/>\n",
                  list, colour, stroke, dashed ? " stroke-dasharray=\"4 4\" opacity=\"0.6\"" : "");
}

void Drawing::dot(const Vec3& p, const std::string& colour, double radius) {
  body_ += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\" fill=\"{}\"/>\n", x(p), y(p),
                       radius, colour);
}

void Drawing::legend(const std::string& text, const std::string& colour) {
  const double at = height_ + row * ++rows_ - 4;
  body_ += fmt::format(
      "<rect x=\"{0}\" y=\"{1:.1f}\" width=\"14\" height=\"4\" fill=\"{2}\"/>\n"
      "<text x=\"{3}\" y=\"{4:.1f}\">{5}</text>\n",
      margin, at - 6, colour, margin + 22, at, escaped(text));
}

void Drawing::scale_bar() {
  const double wanted = 0.2 * (width_ - 2 * margin) / scale_;  // metres for a fifth of the width
  const double power = std::pow(10.0, std::floor(std::log10(wanted)));
  const double metres = wanted >= 5 * power ? 5 * power : wanted >= 2 * power ? 2 * power : power;
  const double right = width_ - margin, at = height_ + row - 4;
  body_ += fmt::format(
      "<line x1=\"{0:.1f}\" y1=\"{2:.1f}\" x2=\"{1:.1f}\" y2=\"{2:.1f}\" stroke=\"#444\" "
      "stroke-width=\"2\"/>\n<text x=\"{1:.1f}\" y=\"{3:.1f}\" text-anchor=\"end\">{4:g} "
      "m</text>\n",
      right - metres * scale_, right, at - 8, at + 6, metres);
}

std::string Drawing::svg() const {
  const double height = height_ + row * std::max(rows_, 1) + 8;
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1:.0f}\" "
      "viewBox=\"0 0 {0} {1:.0f}\" font-family=\"sans-serif\" font-size=\"12\" fill=\"#333\">\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n{2}</svg>\n",
      width_, height, body_);
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '&')
      out += "&amp;";
    else if (c == '"')
      out += "&quot;";
    else
      out += c;
  }
  return out;
}

}  // namespace plan
