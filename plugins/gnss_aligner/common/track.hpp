// SPDX-License-Identifier: BSD-3-Clause
// Where on the path of a mission each of its fixes was measured.
#pragma once
#include "cambium/kinds.hpp"
#include "common/fixes.hpp"

namespace cambium::gnss {

/// How the receiver rides on the robot.
struct Mounting {
  std::vector<double> lever_arm{0, 0, 0};  ///< base frame to antenna, in the base frame [m]
  double time_offset = 0;                  ///< added to the stamps of fixes [s]
  double max_gap = 10;                     ///< between two nodes that a fix may lie between [s]

  void params(ParamVisitor& v);
  std::string check() const;  ///< what is wrong, or nothing
};

/// A fix between two nodes that follow each other in time.
struct Measurement {
  Pair pair;                            ///< of the antenna
  double seconds = 0;                   ///< since the mission's first node
  std::uint32_t before = 0, after = 0;  ///< nodes; the same one when the fix is at its time
  double share = 0;                     ///< of the way from `before` to `after`, 0..1
};

/// What the receiver of one mission measured, in order of time.
struct Track {
  std::uint32_t mission = 0;
  std::vector<Measurement> measurements;
};

/// One track per mission of the island with a fix on its path. Between nodes the base moves on the
/// geodesic of SE3. ENU is the tangent plane at `reference`, the first of these fixes.
struct Tracks {
  Geodetic reference;
  std::vector<Track> tracks;
  std::size_t fixes = 0;  ///< that the missions have, on their path or not

  std::vector<Pair> pairs() const;  ///< of all tracks, one after another
};
Tracks find_tracks(const Atlas& atlas, const Island& island, const Mounting& mounting);

}  // namespace cambium::gnss
