// SPDX-License-Identifier: BSD-3-Clause
// A forest with known truth and what robots bring home from it. docs/simulate.md.
#pragma once
#include <filesystem>

#include "cambium/context.hpp"
#include "simulate/spec.hpp"

namespace cambium::simulate {

struct MissionSummary {
  std::string name;
  std::size_t nodes = 0, points = 0, detections = 0, fixes = 0;
  double length = 0;     ///< of the true path [m]
  double end_error = 0;  ///< of the believed end, seen from the start [m]
};
struct Summary {
  std::size_t stems = 0, loops = 0, loops_between = 0;
  std::vector<MissionSummary> missions;
};

/// Writes OUT/<mission>/..., OUT/stems.csv, OUT/loops.csv, and the text of the specification as
/// OUT/spec.yaml. The same specification gives the same bytes for any number of threads. Throws
/// Error(config) when `out` holds something else or a path does not fit the stand.
Summary simulate(const SimulationSpec& spec, const std::string& text,
                 const std::filesystem::path& out, const Context& context);

}  // namespace cambium::simulate
