// SPDX-License-Identifier: BSD-3-Clause
// Nothing is wrong with this one. Compiled a second time with -mavx2 it is the other alignment.
#include "fixture.hpp"

static const fixture::LeavesTrace trace("CAMBIUM_FIXTURE_" FIXTURE_NAME);

CAMBIUM_PLUGIN("good", "1.2.3") {
  registry.add<fixture::Unchanged>("unchanged", "Gives back the payload as it is");
}
