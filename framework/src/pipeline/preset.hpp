// SPDX-License-Identifier: BSD-3-Clause
// A component that comes with parameters, for commands that take one without a pipeline.
#pragma once
#include <string>
#include <vector>

#include "cambium/plugin.hpp"

namespace cambium {

/// The component, created with the parameters of `settings` ("rings=10"; the option is --set).
/// Mistakes are thrown by create(), as Error(config) with all of them.
Registered preset(Registered component, std::vector<std::string> settings);

}  // namespace cambium
