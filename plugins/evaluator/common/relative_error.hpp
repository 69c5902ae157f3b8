// SPDX-License-Identifier: BSD-3-Clause
// The error of a relative pose, as every evaluator states it.
#pragma once
#include <numbers>
#include <string>
#include <vector>

#include "cambium/kinds.hpp"
#include "cambium/statistics.hpp"

namespace cambium::evaluator {

constexpr double degree = std::numbers::pi / 180;

struct RelativeError {
  double translation;  ///< [m]
  double rotation;     ///< [deg]
};

/// Of an estimated T_a_b against the true one: E = T_true^-1 T_estimated (Sturm et al., "A
/// benchmark for the evaluation of RGB-D SLAM systems", IROS 2012, eq. 1).
inline RelativeError relative_error(const SE3& T_a_b_true, const SE3& T_a_b_estimated) {
  const SE3 error = T_a_b_true.inverse() * T_a_b_estimated;
  return {error.t.norm(), rotation_angle(error) / degree};
}

/// Of many pairs of nodes, in the units of whoever collects them.
struct RelativeErrors {
  std::vector<double> translation, rotation;

  void add(const RelativeErrors& other) {
    translation.insert(translation.end(), other.translation.begin(), other.translation.end());
    rotation.insert(rotation.end(), other.rotation.begin(), other.rotation.end());
  }
};

/// Their root mean squares as `<prefix>translation` and `<prefix>rotation`; nothing of none.
inline void report(const std::string& prefix, const RelativeErrors& errors,
                   const char* translation_unit, const char* rotation_unit,
                   std::vector<Metric>& metrics) {
  if (errors.translation.empty()) return;
  metrics.push_back(
      {prefix + "translation", rms(errors.translation), translation_unit, Better::lower});
  metrics.push_back({prefix + "rotation", rms(errors.rotation), rotation_unit, Better::lower});
}

}  // namespace cambium::evaluator
