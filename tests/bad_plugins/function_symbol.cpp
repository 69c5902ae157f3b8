// SPDX-License-Identifier: BSD-3-Clause
// Exports a function under the name of the descriptor.
#include "fixture.hpp"

FIXTURE_EXPORT void cambium_plugin();
void cambium_plugin() {}
