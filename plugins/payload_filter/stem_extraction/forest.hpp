// SPDX-License-Identifier: BSD-3-Clause
// Made-up stems for the test: what a lidar at the origin of a submap sees of them.
#pragma once
#include <cmath>
#include <vector>

#include "support/support.hpp"

namespace stem_extraction::testing {

using cambium::Cloud;
using cambium::Tree;
using cambium::Vec3;

/// A number between 0 and 1 that depends on a and b only.
inline double number(std::uint64_t a, std::uint64_t b) {
  return double(cambium::Hasher().add(a).add(b).digest().low >> 11) * 0x1.0p-53;
}

/// About normal, mean 0, standard deviation 1.
inline double normal(std::uint64_t a, std::uint64_t b) {
  double sum = -6;
  for (std::uint64_t k = 0; k < 12; ++k) sum += number(a, 100 * b + k);
  return sum;
}

struct Scene {
  double slope = 0;     ///< z = slope * x - height of the sensor
  double eye = 0;       ///< x of the sensor; y = 0 [m]
  double sensor = 1.6;  ///< above the ground at the origin [m]
  double noise = 0.01;  ///< along the ray [m]
  double arc = M_PI;    ///< of a stem that is seen, facing the sensor [rad]
  double top = 6.0;     ///< of what is seen of a stem [m]
  int points = 600;     ///< on a stem
  double ring = 0;      ///< rings of points so far apart in height [m]; 0: everywhere
  Cloud cloud;

  double ground(double x) const { return slope * x - sensor; }
  void add(const Vec3& p) {
    for (int k = 0; k < 3; ++k) cloud.xyz.push_back(float(p[k]));
  }

  void add_ground(double range = 18, int count = 20000) {
    for (int i = 0; i < count; ++i) {
      const double x = range * (2 * number(1, std::uint64_t(i)) - 1);
      const double y = range * (2 * number(2, std::uint64_t(i)) - 1);
      add({x, y, ground(x) + 0.01 * normal(3, std::uint64_t(i))});
    }
  }

  /// `tree` with its base on the ground; returns it.
  Tree add_stem(double x, double y, double dbh, const Vec3& lean = {0, 0, 1}) {
    Tree tree;
    tree.base = {x, y, ground(x)};
    tree.axis = lean.normalized();
    tree.dbh = dbh;
    const std::uint64_t key = std::uint64_t(1000 + cloud.size());
    const double facing = std::atan2(-y, eye - x);
    for (int i = 0; i < points; ++i) {
      const auto k = std::uint64_t(i);
      double along = 0.1 + (top - 0.1) * number(key, 3 * k);
      if (ring > 0) along = ring * std::floor(along / ring) + 0.1;
      // As rays do: evenly across, not evenly around.
      const double angle = facing + std::asin(std::sin(arc / 2) * (2 * number(key, 3 * k + 1) - 1));
      const Vec3 ray = Vec3(x - eye, y, 0).normalized();
      const double radius = dbh / 2 - 0.006 * (along - 1.3);
      add(tree.base + along * tree.axis + radius * Vec3(std::cos(angle), std::sin(angle), 0) +
          noise * normal(key, 3 * k + 2) * ray);
    }
    return tree;
  }
};

inline cambium::Payload apply(cambium::Payload payload, const std::string& yaml = "{}",
                              const cambium::SE3& T_mission_node = {}) {
  using namespace cambium::testing;
  cambium::Mission mission = make_mission("a", {T_mission_node});
  mission.nodes[0].payload = in_memory(std::move(payload));
  const cambium::Atlas atlas = make_atlas({mission});
  return component<cambium::PayloadFilter>("stem_extraction", yaml)
      ->apply({atlas, 0}, 0, *make_context());
}

inline std::vector<Tree> trees(const Cloud& cloud, const std::string& yaml = "{}",
                               const cambium::SE3& T = {}) {
  return *apply(cambium::Payload{std::make_shared<const Cloud>(cloud), nullptr}, yaml, T).trees;
}

}  // namespace stem_extraction::testing
