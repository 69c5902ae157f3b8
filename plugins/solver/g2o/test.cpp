// SPDX-License-Identifier: BSD-3-Clause
#include "common/solver_laws.hpp"

const char* cambium::testing::solver_under_test() { return "g2o"; }
