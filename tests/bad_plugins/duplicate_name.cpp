// SPDX-License-Identifier: BSD-3-Clause
// Registers a new name first and then one that good.cpp has: neither may stay.
#include "fixture.hpp"

CAMBIUM_PLUGIN("duplicate_name", "1.0.0") {
  registry.add<fixture::Unchanged>("another", "Must not stay registered");
  registry.add<fixture::Unchanged>("unchanged", "The name that good.cpp has");
}
