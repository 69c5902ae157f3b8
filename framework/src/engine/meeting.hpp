// SPDX-License-Identifier: BSD-3-Clause
// Which missions can have seen the same place, by what is known of where they were: so that the
// work grows with the pairs that can meet, not with all pairs.
#pragma once
#include <optional>
#include <vector>

#include "cambium/atlas.hpp"

namespace cambium {

/// A rectangle that holds the whole path of a mission, in a frame that several missions share [m].
struct Whereabouts {
  Eigen::Array2d low, high;
};

class Meetings {
 public:
  /// Why two missions need not be compared.
  enum class Apart { no, by_gnss, by_map };

  /// Missions whose paths lie more than `max_distance` [m] apart never met; 0: all may have.
  Meetings(const Atlas& atlas, double max_distance);

  /// Of missions in one island the map decides, of others GNSS; without either they may have met.
  Apart apart(std::uint32_t a, std::uint32_t b) const;

 private:
  const Atlas& atlas_;
  double max_distance_;
  std::vector<std::optional<Whereabouts>> globe_;  // of each mission
  std::vector<Whereabouts> map_;
};

/// Where GNSS puts the mission, in ENU about `reference`: its fixes with three sigmas, and where
/// the robot may have gone out of their sight; else the place of its georeference, whichever
/// way its frame is turned. Nothing when neither says enough (fewer than five fixes on the path).
std::optional<Whereabouts> on_the_globe(const Mission& mission, const GeoReference& reference);

/// Where the map puts it, with what its path may have drifted (5 %).
Whereabouts on_the_map(const MissionState& state);

}  // namespace cambium
