// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>

#include "pipeline/pipeline.hpp"

namespace cambium {

/// One entry of `steps:`. Mistakes go to `diagnostics`; nothing when no verb was found.
std::optional<StepSpec> parse_step(const Yaml& step, Diagnostics& diagnostics);

/// `platforms:`, put into the steps that it overrides.
void parse_platforms(const Yaml& platforms, Pipeline& pipeline, Diagnostics& diagnostics);

}  // namespace cambium
