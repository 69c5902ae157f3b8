// SPDX-License-Identifier: BSD-3-Clause
// A levelled scan as a plan: where surfaces stand upright, seen from above, turned to many headings
// and transformed, so that two plans are correlated over all translations at once.
#pragma once
#include <Eigen/Core>
#include <complex>
#include <vector>

#include "common/surface.hpp"
#include "fft.hpp"

namespace cambium::registration {

/// The grid of all plans of one configuration. It is periodic: what sticks out comes in again on
/// the other side, so it must be wide enough for two scans side by side.
struct PlanGrid {
  double cell = 1;        ///< [m]
  int width = 128;        ///< cells
  int headings = 45;      ///< over half a turn; the other half mirrors them
  double max_range = 45;  ///< points farther out are left out [m]
  double turn(int heading) const { return M_PI * heading / headings; }
};

struct Plan {
  Eigen::Matrix3f R_level_base = Eigen::Matrix3f::Identity();
  /// Per heading the transform of the plan turned by it, F(k) for k_x in 0..width/2: the plan is
  /// real, so the rest is its mirror image.
  std::vector<std::vector<std::complex<float>>> spectra;
  std::vector<float> ground;  ///< lowest point of each cell at heading 0 [m, levelled]; NaN: none
  std::size_t bytes() const;
};

Plan make_plan(const Patches& patches, const PlanGrid& grid, const Fft& fft);

}  // namespace cambium::registration
