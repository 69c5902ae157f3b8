// SPDX-License-Identifier: BSD-3-Clause
// The parameters that every solver has.
#pragma once
#include <string>

#include "cambium/params.hpp"
#include "common/minimizer.hpp"

namespace cambium::pose_solver {

struct Settings {
  std::string loss = "none";
  double loss_width = 3.0;
  std::string initialization = "chordal";
  Limits limits;
  bool diagnostics = false;
  bool certify = false;
  std::string odometry = "as_given";

  void params(ParamVisitor& v);
  bool gnc() const { return loss == "gnc"; }
  bool calibrates() const { return odometry == "calibrated"; }
};

}  // namespace cambium::pose_solver
