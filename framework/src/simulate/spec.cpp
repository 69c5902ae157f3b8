// SPDX-License-Identifier: BSD-3-Clause
#include "simulate/spec.hpp"

#include <fmt/format.h>

#include <numbers>

namespace cambium::simulate {

void SimulationSpec::params(ParamVisitor& v) {
  v("seed", seed, "Every random number follows from it", at_least(0));
  v("latitude", latitude, "Of the world's origin, WGS 84", between(-89, 89, "deg"));
  v("longitude", longitude, "Of the world's origin, WGS 84", between(-180, 180, "deg"));
  v("altitude", altitude, "Of the world's origin above the ellipsoid", between(-500, 9000, "m"));
}

void TerrainSpec::params(ParamVisitor& v) {
  v("max_slope", max_slope, "The steepest slope of the area; 0 = level", between(0, 45, "deg"));
  v("wavelength", wavelength, "Width of the largest hills; two finer octaves lie on top",
    between(8, 1000, "m"));
  v("roughness", roughness, "Standard deviation of the ground between neighbouring metres",
    between(0, 0.5, "m"));
}

void StandSpec::params(ParamVisitor& v) {
  v("size", size, "Width (east) and depth (north) of the area, centred on the origin",
    between(10, 5000, "m"));
  v("pattern", pattern,
    "matern: random with a least distance; lattice: rows of a plantation; clustered: groups",
    one_of({"matern", "lattice", "clustered"}));
  v("density", density, "Stems a hectare; 0 = no trees", between(0, 5000, "1/ha"));
  v("hard_core", hard_core, "No two stems are nearer (not used by lattice)", between(0.2, 5, "m"));
  v("jitter", jitter, "Standard deviation of a planted stem from its place in the lattice",
    between(0, 2, "m"));
  v("cluster_radius", cluster_radius, "Standard deviation of a clustered stem from its centre",
    between(0.5, 50, "m"));
  v("cluster_size", cluster_size, "Mean number of stems in a cluster, before thinning",
    between(1, 200));
  v("dbh_mean", dbh_mean, "Mean diameter at breast height", between(0.03, 2, "m"));
  v("dbh_sd", dbh_sd, "Its standard deviation; the distribution is Weibull's",
    between(0.001, 1, "m"));
  v("dominance", dominance, "The thickest trees keep this distance from one another; 0 = chance",
    between(0, 20, "m"));
  v("naslund_a", naslund_a, "height = 1.3 + d^2 / (a + b d)^2 with d in cm (Naslund 1936)",
    between(0, 10));
  v("naslund_b", naslund_b, "See naslund_a", between(0.05, 1));
  v("height_sd", height_sd, "Standard deviation of the height from Naslund's curve",
    between(0, 5, "m"));
  v("lean", lean, "Standard deviation of the stem axis from the vertical, about each of two axes",
    between(0, 20, "deg"));
  v("clearings", clearings, "Circles without trees: x, y, radius, x, y, radius, ...", in_unit("m"));
}

std::string StandSpec::check_params() const {
  if (size.size() != 2) return "'size' must be two numbers, [width, depth]";
  if (clearings.size() % 3 != 0) return "'clearings' must be triples of x, y, radius";
  if (dbh_sd > 1.5 * dbh_mean) return "'dbh_sd' must not exceed 1.5 times 'dbh_mean'";
  // Matern II cannot be denser than one stem in a disc of the hard core's radius.
  const double most = 0.95 * 1e4 / (std::numbers::pi * hard_core * hard_core);
  if (pattern == "matern" && density > most)
    return fmt::format("a hard core of {} m allows {:.0f} stems/ha, found density {}; lower one",
                       hard_core, most, density);
  return {};
}

void FoliageSpec::params(ParamVisitor& v) {
  v("extinction", extinction, "Of a laser ray in a crown, on average; 0 = bare stems",
    between(0, 5, "1/m"));
  v("crown_base", crown_base, "Where a crown begins, as a share of the tree's height",
    between(0, 0.95));
  v("crown_radius", crown_radius, "Of a tree of the mean diameter; grows with its square root",
    between(0.3, 10, "m"));
  v("clumping", clumping, "Spread of the extinction between neighbouring voxels (log-normal)",
    between(0, 2));
  v("understory", understory, "Extinction of grass and shrubs over the ground; 0 = none",
    between(0, 5, "1/m"));
  v("understory_height", understory_height, "Up to which height", between(0, 5, "m"));
}

void ClutterSpec::params(ParamVisitor& v) {
  v("density", density, "Snags, shrubs and poles that look like stems; 0 = none",
    between(0, 5000, "1/ha"));
  v("lean", lean, "Standard deviation of their axes from the vertical", between(0, 40, "deg"));
  v("max_height", max_height, "The tallest of them", between(0.5, 10, "m"));
}

void LoopsSpec::params(ParamVisitor& v) {
  v("max_baseline", max_baseline, "loops.csv lists pairs of nodes that are at most this far apart",
    above(0, "m"));
  v("min_overlap", min_overlap, "and that share this much of what the one with less saw",
    between(0, 1));
  v("min_gap", min_gap, "Within a mission: and are at least so many nodes apart", at_least(1));
}

void MissionSpec::params(ParamVisitor& v) {
  v("name", name, "Of the mission's folder");
  v("platform", platform, "PLATFORM_ID of the robot", at_least(0));
  v("start", start, "Unix time of the first node; 0 = an hour after the mission before",
    at_least(0));
  v("harvested", harvested, "Share of the trees that were cut before this mission", between(0, 1));
  v("growth", growth,
    "What the diameters have grown before this mission, on average; a stem grows half of it to one "
    "and a half times",
    between(0, 0.5, "m"));
  v("gravity_tilt", gravity_tilt, "Angle between the mission's z axis and the vertical",
    between(0, 90, "deg"));
  v("duplicate_stamps", duplicate_stamps, "So many nodes carry the stamp of the node before them",
    at_least(0));
  v("carried_at", carried_at, "Before this node the robot is carried away unseen; 0 = never",
    at_least(0));
  v("carried_by", carried_by, "Where to: east and north of where it stood", in_unit("m"));
}

std::string MissionSpec::check_params() const {
  if (name.empty()) return "a mission needs a 'name'";
  if (name.find_first_of("/\\\"\n") != name.npos || name[0] == '.')
    return fmt::format("'{}' cannot be the name of a folder", name);
  if (carried_by.size() != 2) return "'carried_by' must be two numbers, [east, north]";
  return {};
}

}  // namespace cambium::simulate
