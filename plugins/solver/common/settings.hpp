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

  void params(ParamVisitor& v);
  bool gnc() const { return loss == "gnc"; }
};

}  // namespace cambium::pose_solver
