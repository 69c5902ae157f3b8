// SPDX-License-Identifier: BSD-3-Clause
// What a component costs, beside the others of its kind, on the kit's forest or on recordings.
#pragma once
#include <optional>

#include "conformance/law.hpp"

namespace cambium::conformance {

/// One component at one size of payloads.
struct Measured {
  std::string component;
  double points = 0;        ///< of the clouds, on average
  std::size_t uses = 0;     ///< that were timed
  double milliseconds = 0;  ///< of one use as the laws make it (see use_of), the median
  double megabytes = 0;     ///< resident memory that a use needed on top of what there was, at most
  std::string refusal;      ///< why there are no figures
  /// Of recognisers: queries with a reference within 5 m whose best candidate is such a one, and
  /// the share of all best candidates that are.
  std::optional<double> recall, precision;
};

/// What is timed: "describes 3 missions, matches 2 pairs of them", "aligns 1 pair", ...
const char* use_of(Kind kind);

/// The world with every `step`-th point of each cloud, and every tree.
World thinned(const World& world, std::size_t step);

/// Uses `component` for at least `seconds` and three times, on one thread.
Measured measure(const Registered& component, const Registry& registry, const World& world,
                 double seconds);

/// A world of two recordings that lie in an atlas, at their true poses where there is a truth, else
/// at the robots' own.
World world_of(Atlas atlas);

}  // namespace cambium::conformance
