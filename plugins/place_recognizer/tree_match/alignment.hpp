// SPDX-License-Identifier: BSD-3-Clause
// Lays the stems of a query on those of the reference mission.
#pragma once
#include <optional>
#include <span>
#include <vector>

#include "cambium/se3.hpp"
#include "coverage.hpp"
#include "stem_grid.hpp"
#include "voting.hpp"

namespace tree_match {

/// A query's stem and the reference's stem that it lies on.
struct Match {
  std::uint32_t query, reference;
  float squared;  ///< horizontal distance [m^2]
};

struct Overlay {
  Planar T_reference_query;
  std::vector<Match> matches;  ///< one to one, by the query's stem
  double score = 0;            ///< log likelihood ratio: this pose against any pose
};

struct AlignmentLimits {
  double coarse_radius = 0.7;        ///< of matches, when a hypothesis is new [m]
  double radius = 0.5;               ///< of matches, in the end [m]
  double max_dbh_difference = 0.15;  ///< [m]
  double sigma = 0.2;                ///< of the distance of two matched stems, per axis [m]
  double cover = 3.0;                ///< the reference has seen what lies so near to a stem [m]
  double detection = 0.5;            ///< share of a map's stems that another map has, too
};

/// Different stems per square metre around each stem.
std::vector<float> densities(std::span<const Stem> stems, const StemGrid& grid);

/// The stems that fit the reference's, of all that were last seen before node `end`.
class Overlayer {
 public:
  Overlayer(std::span<const Stem> reference, const StemGrid& grid, const AlignmentLimits& limits)
      : reference_(reference), grid_(grid), limits_(limits), owner_(reference.size(), no_match) {}

  /// Matches within coarse_radius and refits in closed form. No score yet.
  Overlay start(std::span<const Stem> query, const Planar& T_reference_query, std::uint32_t end);
  /// Twice more within radius.
  void finish(std::span<const Stem> query, std::uint32_t end, Overlay& overlay);

  /// The logarithm of how much likelier the query's stems are at this pose than anywhere: a stem
  /// that is matched counts by the density of the reference's stems around it, so that little is
  /// won in a thicket; one that is not matched, where the reference has stems, counts against it.
  /// Looks at every `step`-th stem only.
  double evidence(std::span<const Stem> query, std::span<const float> density,
                  const Coverage& coverage, std::uint32_t end, std::uint32_t step,
                  const Overlay& overlay) const;

 private:
  static constexpr std::uint32_t no_match = ~std::uint32_t(0);

  void match(std::span<const Stem> query, double radius, std::uint32_t end, Overlay& overlay);
  void refine(std::span<const Stem> query, double radius, std::uint32_t end, Overlay& overlay);

  std::span<const Stem> reference_;
  const StemGrid& grid_;
  AlignmentLimits limits_;
  std::vector<std::uint32_t> owner_;  // which match holds a stem of the reference
};

/// Two frames whose verticals differ by more were not levelled alike: one has a wrong gravity
/// [rad].
constexpr double wrong_gravity = 0.087;

/// Lifts the planar motion to space: height, roll and pitch from the bases of the matched stems,
/// dz = z + roll y - pitch x, by reweighted least squares with Cauchy's loss. `sigma_tilt` [rad]
/// is how well gravity is known: a few stems in a line do not tilt the map. Nothing where fewer
/// than three matches know their heights.
std::optional<cambium::SE3> lift(const Overlay& overlay, std::span<const Stem> query,
                                 std::span<const Stem> reference, double sigma_tilt);

}  // namespace tree_match
