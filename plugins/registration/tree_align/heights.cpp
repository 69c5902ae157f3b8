// SPDX-License-Identifier: BSD-3-Clause
// Where up is, and how far up.
#include <algorithm>
#include <cmath>

#include "cambium/statistics.hpp"
#include "stems.hpp"

namespace tree_align {

using cambium::Quat;
using cambium::SE3;
using cambium::Tree;
using cambium::Vec3;

Quat q_upright_target(const std::vector<Tree>& target, const std::vector<Tree>& source,
                      const Quat& q_target_source) {
  constexpr double nearest = 0.01;  // [rad], an axis may not outweigh all others
  std::vector<Vec3> axes;
  for (const Tree& t : target) axes.push_back(t.axis);
  for (const Tree& t : source) axes.push_back(q_target_source * t.axis);
  Vec3 up = Vec3::UnitZ();
  for (int i = 0; i < 20; ++i) {
    Vec3 sum = Vec3::Zero();
    for (const Vec3& axis : axes) sum += axis / std::max(nearest, (axis - up).norm());
    if (!(sum.norm() > 0)) return Quat::Identity();
    up = sum.normalized();
  }
  return Quat(Quat::FromTwoVectors(up, Vec3::UnitZ()));
}

std::vector<Tree> turned(const Quat& q, std::vector<Tree> trees) {
  for (Tree& t : trees) {
    t.base = q * t.base;
    t.axis = q * t.axis;
  }
  return trees;
}

Heights heights(const std::vector<Tree>& target, const std::vector<Tree>& source,
                const std::vector<Pair>& pairs, const SE3& T_target_source) {
  constexpr double widest = 3.0, narrowest = 0.1, agree = 0.2;  // [m]
  std::vector<double> dz;
  for (const Pair& p : pairs)
    dz.push_back((target[p.target].base - T_target_source * source[p.source].base).z());
  Heights out;
  out.offset = cambium::median(dz);
  out.weights.assign(dz.size(), 1.0);
  for (double width = widest; width > narrowest; width *= 0.8) {
    double sum = 0, weights = 0;
    for (std::size_t i = 0; i < dz.size(); ++i) {
      const double r = (dz[i] - out.offset) / width;
      out.weights[i] = 1 / ((1 + r * r) * (1 + r * r));  // Geman and McClure's
      sum += out.weights[i] * dz[i];
      weights += out.weights[i];
    }
    out.offset = sum / weights;
  }
  const auto near = [&](double d) { return std::abs(d - out.offset) < agree; };
  out.share = double(std::count_if(dz.begin(), dz.end(), near)) / double(dz.size());
  return out;
}

}  // namespace tree_align
