// SPDX-License-Identifier: BSD-3-Clause
// Registers one name twice.
#include "fixture.hpp"

CAMBIUM_PLUGIN("duplicate_inside", "1.0.0") {
  registry.add<fixture::Unchanged>("twice", "First");
  registry.add<fixture::Unchanged>("twice", "Second");
}
