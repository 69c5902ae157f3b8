// SPDX-License-Identifier: BSD-3-Clause
// Needs a library that is not where the dynamic loader looks.
#include "fixture.hpp"

int from_a_library_that_is_gone();

CAMBIUM_PLUGIN("missing_dependency", "1.0.0") {
  if (from_a_library_that_is_gone() == 1)
    registry.add<fixture::Unchanged>("needs_gone", "Never seen");
}
