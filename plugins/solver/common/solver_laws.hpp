// SPDX-License-Identifier: BSD-3-Clause
// What every solver must keep, whatever its method. A plugin's test includes this and defines
//   const char* cambium::testing::solver_under_test() { return "ceres"; }
#pragma once
#include "common/laws/bad_input.hpp"
#include "common/laws/calibration.hpp"
#include "common/laws/gauge.hpp"
#include "common/laws/optimum.hpp"
#include "common/laws/report.hpp"
#include "common/laws/robust.hpp"
