// SPDX-License-Identifier: BSD-3-Clause
// The trees, and what looks like trees. World frame: east, north, up [m].
#pragma once
#include <vector>

#include "simulate/terrain.hpp"

namespace cambium::simulate {

/// A straight, tapered, leaning stem: a cone whose radius at breast height is dbh / 2.
struct Stem {
  Vec3 base = Vec3::Zero();   ///< on the ground
  Vec3 axis = Vec3::UnitZ();  ///< unit vector, up
  double dbh = 0;             ///< 1.3 m along the axis
  double height = 0;          ///< length along the axis
  std::uint64_t mark = 0;     ///< random, for all that is decided stem by stem

  double radius_at(double along) const;  ///< distance from the base along the axis [m]
};

std::vector<Stem> plant(const StandSpec& spec, const Terrain& terrain, std::uint64_t seed);

/// Snags, shrubs and poles: short, thin, leaning. They are in no stem map.
std::vector<Stem> scatter_clutter(const ClutterSpec& spec, const StandSpec& stand,
                                  const Terrain& terrain, std::uint64_t seed);

/// The stems that still stand after a share of them was cut. A larger share cuts the same and more.
std::vector<Stem> after_harvest(const std::vector<Stem>& stems, double share, std::uint64_t seed);

/// The stems with thicker diameters: each by half to one and a half of `mean` [m], its own share
/// the same for any mean. Heights stay.
std::vector<Stem> after_growth(std::vector<Stem> stems, double mean, std::uint64_t seed);

}  // namespace cambium::simulate
