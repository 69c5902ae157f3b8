// SPDX-License-Identifier: BSD-3-Clause
#include "fixture.hpp"

static const fixture::LeavesTrace trace("CAMBIUM_FIXTURE_older_api");
static void fill(cambium::Registry&) {}

FIXTURE_EXPORT const cambium::PluginDescriptor cambium_plugin;
const cambium::PluginDescriptor cambium_plugin =
    fixture::with_api(cambium::api_major, cambium::api_minor_oldest - 1, &fill);
