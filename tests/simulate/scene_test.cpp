// SPDX-License-Identifier: BSD-3-Clause
// Ray casting against closed forms, and the grid against all cones one by one.
#include "simulate/scene.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "simulate/angles.hpp"
#include "simulate/random.hpp"

namespace cambium::simulate {
namespace {

constexpr float clear_air = std::numeric_limits<float>::infinity();  // no leaf stops the ray

/// Ground z = a + east * x + north * y.
Terrain inclined(double a, double east, double north, int size = 60) {
  Terrain t;
  t.x0 = t.y0 = -size / 2;
  t.nx = t.ny = size;
  for (int iy = 0; iy <= size; ++iy)
    for (int ix = 0; ix <= size; ++ix)
      t.heights.push_back(float(a + east * (t.x0 + ix) + north * (t.y0 + iy)));
  return t;
}

Foliage no_leaves(const Terrain& t) {
  return {t.nx, t.ny, 1, -1e3, std::vector<float>(t.heights.size())};
}

Stem stem_at(double x, double y, double dbh, double height, const Vec3& axis = Vec3::UnitZ()) {
  Stem s;
  s.base = {x, y, 0};
  s.axis = axis;
  s.dbh = dbh, s.height = height;
  return s;
}

Eigen::Vector3f any_direction(Random& r, double lowest, double highest) {
  const double a = r.uniform(0, 2 * M_PI), z = r.uniform(lowest, highest);
  return Vec3(std::sqrt(1 - z * z) * std::cos(a), std::sqrt(1 - z * z) * std::sin(a), z)
      .cast<float>();
}

TEST(RayCasting, InclinedPlane) {
  const double a = -1, east = 0.2, north = -0.1;
  const Terrain t = inclined(a, east, north);
  const Scene scene(t, {}, {}, no_leaves(t));
  Random r(1, "plane");
  const Vec3 origin(0.3, -0.7, 1.5), normal(-east, -north, 1);
  int hits = 0;
  for (int i = 0; i < 5000; ++i) {
    const Eigen::Vector3f d = any_direction(r, -1, 0.3);
    const double expected = (a - normal.dot(origin)) / normal.dot(d.cast<double>());
    const Vec3 place = origin + expected * d.cast<double>();
    const bool inside = place.head<2>().cwiseAbs().maxCoeff() < 30;
    const Hit hit = scene.cast(origin.cast<float>(), d, 80, clear_air);
    if (expected > 0 && expected < 80 && inside) {
      ++hits;
      ASSERT_EQ(hit.surface, Surface::ground);
      ASSERT_NEAR(hit.range, expected, 2e-3 + 2e-4 * expected) << d.transpose();
    } else {
      ASSERT_EQ(hit.surface, Surface::none);
    }
  }
  EXPECT_GT(hits, 3000);
}

TEST(RayCasting, HorizontalRaysMeetAStemAtItsRadius) {
  const Terrain t = inclined(-5, 0, 0);
  const Stem stem = stem_at(7.3, 4.1, 0.3, 20);
  const Scene scene(t, {stem}, {}, no_leaves(t));
  for (const double z : {0.2, 1.3, 6.0, 12.0}) {
    const Vec3 origin(0, 0, z), to(7.3, 4.1, z);
    const Vec3 d = (to - origin).normalized();
    const Hit hit = scene.cast(origin.cast<float>(), d.cast<float>(), 50, clear_air);
    ASSERT_EQ(hit.surface, Surface::stem);
    EXPECT_NEAR(hit.range, (to - origin).norm() - stem.radius_at(z), 1e-4);
    // Just outside the radius, nothing.
    const Vec3 side = Vec3(-d.y(), d.x(), 0) * (stem.radius_at(z) + 1e-3);
    EXPECT_EQ(scene.cast((origin + side).cast<float>(), d.cast<float>(), 50, clear_air).surface,
              Surface::none);
  }
  EXPECT_EQ(scene.cast({0, 0, 21}, {1, 0, 0}, 50, clear_air).surface, Surface::none);
}

TEST(RayCasting, HitsOnALeaningStemLieOnItsSurface) {
  const Terrain t = inclined(-5, 0, 0);
  const Stem stem = stem_at(5, 2, 0.4, 18, leaning(radians(15), radians(-10)));
  const Scene scene(t, {}, {stem}, no_leaves(t));
  Random r(3, "leaning");
  int hits = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3 origin(r.uniform(-2, 2), r.uniform(-2, 2), 1.5);
    const Eigen::Vector3f d = any_direction(r, -0.2, 0.9);
    const Hit hit = scene.cast(origin.cast<float>(), d, 50, clear_air);
    if (hit.surface != Surface::clutter) continue;
    ++hits;
    const Vec3 from_base = origin + double(hit.range) * d.cast<double>() - stem.base;
    const double along = from_base.dot(stem.axis);
    ASSERT_NEAR((from_base - along * stem.axis).norm(), stem.radius_at(along), 1e-3);
  }
  EXPECT_GT(hits, 100);
}

// The grid must find what a loop over all cones finds; far origins are moved near, as the grid
// does.
TEST(RayCasting, GridAgreesWithAllConesOneByOne) {
  const Terrain t = inclined(-3, 0.05, 0.02);
  Random r(9, "grid");
  std::vector<Stem> stems;
  for (int i = 0; i < 250; ++i) {
    const double x = r.uniform(-29, 29), y = r.uniform(-29, 29), lean = 0.08;
    const double about_x = lean * r.normal(), about_y = lean * r.normal();
    stems.push_back(
        stem_at(x, y, r.uniform(0.05, 0.8), r.uniform(3, 25), leaning(about_x, about_y)));
  }
  const Scene scene(t, stems, {}, no_leaves(t));
  const Scene ground(t, {}, {}, no_leaves(t));
  int hits = 0, misses = 0;
  for (int i = 0; i < 20000; ++i) {
    const Eigen::Vector3f origin(float(r.uniform(-25, 25)), float(r.uniform(-25, 25)), 1.5f);
    const Eigen::Vector3f d = any_direction(r, -0.4, 0.6);
    const Hit soil = ground.cast(origin, d, 60, clear_air);
    double nearest = soil.surface == Surface::ground ? soil.range : 1e9;
    bool within = false;
    for (const Stem& s : stems) {
      const Cone cone{s.base.cast<float>(), s.axis.cast<float>(), float(s.radius_at(0)),
                      float(s.height)};
      const float shift = std::max(0.f, (cone.base - origin).dot(d) - 3);
      const float range = cone.hit(origin + shift * d, d) + shift;
      within |= (cone.base - origin).head<2>().norm() < 3;
      if (range > shift && range < nearest) nearest = range;
    }
    if (within) continue;  // may stand inside of a stem
    const Vec3 end = (origin + float(nearest) * d).cast<double>();
    if (end.head<2>().cwiseAbs().maxCoeff() > 29.5) continue;
    const Hit hit = scene.cast(origin, d, 60, clear_air);
    hits += hit.surface == Surface::stem;
    misses += std::abs(double(hit.range) - nearest) > 5e-3;  // a ray that grazes bark may differ
  }
  EXPECT_GT(hits, 500);
  EXPECT_LE(misses, hits / 500);
}

TEST(RayCasting, UniformFoliageStopsARayAtItsOpticalDepth) {
  const Terrain t = inclined(-50, 0, 0);
  Foliage leaves{t.nx, t.ny, 40, -20, {}};
  const float extinction = 0.4f;
  leaves.extinction.assign(std::size_t(t.nx * t.ny * leaves.layers), extinction);
  const Scene scene(t, {}, {}, leaves);
  Random r(5, "leaves");
  for (int i = 0; i < 3000; ++i) {
    const Eigen::Vector3f d = any_direction(r, -0.5, 0.5), origin(0.2f, 0.1f, 0.3f);
    const float depth = float(r.exponential(1));
    const Hit hit = scene.cast(origin, d, 25, depth);
    if (depth / extinction < 25) {
      ASSERT_EQ(hit.surface, Surface::foliage);
      ASSERT_NEAR(hit.range, depth / extinction, 2e-3);
    } else {
      ASSERT_EQ(hit.surface, Surface::none);
    }
  }
}

TEST(RayCasting, FoliageHidesAStemBehindIt) {
  const Terrain t = inclined(-5, 0, 0);
  Foliage leaves{t.nx, t.ny, 30, 0, std::vector<float>(std::size_t(t.nx * t.ny) * 30)};
  for (int iy = 0; iy < t.ny; ++iy) leaves.at(34, iy, 1) = 2;  // a hedge of 1 m at x = 4..5
  const Scene scene(t, {stem_at(8, 0.5, 0.4, 15)}, {}, leaves);
  const Eigen::Vector3f origin(0, 0.5f, 1.5f), east(1, 0, 0);
  EXPECT_EQ(scene.cast(origin, east, 30, 2.1f).surface, Surface::stem);
  const Hit hit = scene.cast(origin, east, 30, 1.0f);
  EXPECT_EQ(hit.surface, Surface::foliage);
  EXPECT_NEAR(hit.range, 4.5, 1e-4);
}

TEST(RayCasting, FromAboveTheForest) {
  const Terrain t = inclined(2, 0, 0);
  const Scene scene(t, {stem_at(3, 3, 0.3, 15)}, {}, no_leaves(t));
  const Hit hit = scene.cast({0.5f, 0.5f, 80}, {0, 0, -1}, 200, clear_air);
  EXPECT_EQ(hit.surface, Surface::ground);
  EXPECT_NEAR(hit.range, 78, 1e-3);
  EXPECT_EQ(scene.cast({0.5f, 0.5f, 80}, {0, 0, 1}, 200, clear_air).surface, Surface::none);
}

}  // namespace
}  // namespace cambium::simulate
