// SPDX-License-Identifier: BSD-3-Clause
// Registers one component, then fails: neither may stay.
#include "fixture.hpp"

CAMBIUM_PLUGIN("throws_in_fill", "1.0.0") {
  registry.add<fixture::Unchanged>("half", "Must not stay registered");
  throw std::runtime_error("the calibration file is missing");
}
