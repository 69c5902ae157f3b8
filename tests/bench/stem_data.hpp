// SPDX-License-Identifier: BSD-3-Clause
// Simulated forests with one robot in them, in memory, for bench_stems.
#pragma once
#include <string>
#include <vector>

#include "simulate/recording.hpp"
#include "support/support.hpp"

namespace cambium::bench {

struct Forest {
  simulate::Terrain terrain;
  std::vector<simulate::Stem> stems;
  std::vector<SE3> T_world_node;  ///< true poses
  Atlas atlas;                    ///< one mission with its clouds
};

/// What the specification (docs/simulate.md) grows, seen by its only mission.
Forest grow_forest(const std::string& specification);

/// A walk of 60 m, a scan every 2 m, through the default stand: 940 stems/ha, foliage, clutter.
struct Walk {
  int slope = 0;  ///< steepest of the terrain [deg]
  int beams = 64;
  double drift = 0.5;  ///< of the odometry after 100 m [%]
  int seed = 1;
};
std::string specification(const Walk& walk);

/// The forest's payload of `node` after a filter; `seconds` of processor time are added.
Payload filtered(const Forest& forest, std::size_t node, const PayloadFilter& filter,
                 double& seconds);
/// The forest with another payload at `node`.
Forest with_payload(const Forest& forest, std::size_t node, Payload payload);

/// How extracted trees compare with the true ones.
struct Tally {
  std::size_t nodes = 0;
  std::size_t stems = 0, found = 0;               ///< true ones of at least `counted_dbh`
  std::size_t reported = 0, right = 0;            ///< reported ones within range
  std::size_t thin = 0, thin_found = 0;           ///< true ones between min_dbh and counted_dbh
  std::vector<double> dbh, position, base, lean;  ///< errors [m], [m], [m], [rad] of the right ones
  double seconds = 0;                             ///< of processor time
};

struct Judging {
  double range = 15.0;        ///< true stems and reports farther from the node do not count [m]
  double radius = 0.3;        ///< a report belongs to a stem at most so far away, at 1.3 m [m]
  double counted_dbh = 0.10;  ///< thinner stems are counted apart [m]
  double min_dbh = 0.05;      ///< thinner stems are not asked for [m]
  /// A report on one of those does not count, unless it is thicker by more than this: then it is
  /// wrong, not a right one with a wrong diameter [m].
  double sapling_error = 0.03;
};

/// One node's trees (base frame) against the truth. Pairs are one to one, nearest first.
void judge(const Forest& forest, std::size_t node, const std::vector<Tree>& trees,
           const Judging& judging, Tally& tally);

}  // namespace cambium::bench
