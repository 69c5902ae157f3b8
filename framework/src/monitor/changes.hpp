// SPDX-License-Identifier: BSD-3-Clause
// What changed between two surveys of one place: trees, ground and canopy.
#pragma once
#include "cambium/ground.hpp"
#include "monitor/json.hpp"
#include "monitor/survey.hpp"

namespace cambium::monitor {

struct ChangesOptions {
  StemOptions stems;
  double match_radius = 0.5;  ///< trees of both surveys so near each other are the same one [m]
  /// A tree is gone (or new) where the other survey should have detected it so often.
  double min_expected = 3;
  /// A thicker tree that the first survey lacks cannot have grown since: it was overlooked [m].
  double max_growth = 0.05;
  GroundOptions cells;  ///< of the grid of heights
};

enum class Change { kept, gone, appeared, overlooked, unsure };
const char* to_string(Change change);

struct StemChange {
  Change change = Change::unsure;
  Vec3 base = Vec3::Zero();             ///< in the map of the first survey
  std::optional<Stem> before, after;    ///< where each survey has the tree, in its own map
  double growth = 0, growth_sigma = 0;  ///< of the diameter [m]; NaN where it is not known
  double expected = 0;   ///< detections that the survey without the tree should have, were it there
  std::size_t near = 0;  ///< detections that it has there, too few for a tree
  std::string reason;    ///< why it is unsure
};

/// Heights of the second survey above the first in one cell of the first one's map [m]. Canopy is
/// taken from the ground around: what lies between the grounds is not in it.
struct CellChange {
  Cell cell{};
  std::optional<double> ground, canopy;  ///< nothing where not both surveys saw it
  std::optional<double> level = {};      ///< of the first survey's ground there [m]
};

struct Changes {
  SE3 T_before_after;             ///< the second survey's map in the first one's
  std::size_t aligned_by = 0;     ///< trees that moved the second map onto the first; 0: one map
  double aligned_rms = 0;         ///< their distance after that [m]
  std::vector<StemChange> stems;  ///< ordered by base
  std::vector<CellChange> cells;  ///< ordered by cell
};

/// Surveys that are missions of one run stand in its map. Others must be georeferenced; what GNSS
/// leaves between them (up to some metres and degrees) is taken out by the trees that they share.
/// Throws Error(config) when they have no common frame, Error(check) when too few trees agree.
Changes changes(const Survey& before, const Survey& after, const ChangesOptions& options,
                const Context& context);

/// The second survey's map in the first one's, with what the trees say.
void align(const Survey& before, const Survey& after, const std::vector<Stem>& stems_before,
           const std::vector<Stem>& stems_after, Changes& out);

/// Compares trees; needs T_before_after. Looks for what each survey should have seen.
std::vector<StemChange> compare_stems(const Survey& before, const Survey& after,
                                      const std::vector<Stem>& stems_before,
                                      const std::vector<Stem>& stems_after,
                                      const SE3& T_before_after, const ChangesOptions& options,
                                      const Context& context);

/// The island that all missions of a survey are in. Throws Error(config) when they are in several.
std::uint32_t island_of(const Survey& survey);

}  // namespace cambium::monitor
