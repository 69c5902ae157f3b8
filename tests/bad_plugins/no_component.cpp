// SPDX-License-Identifier: BSD-3-Clause
// Forgot to register anything.
#include "fixture.hpp"

CAMBIUM_PLUGIN("no_component", "1.0.0") {}
