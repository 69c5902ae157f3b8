// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <nlohmann/json.hpp>

#include "cambium/plugin.hpp"

namespace cambium {

/// JSON Schema (draft 7) of a pipeline file, with the components of the registry: what editors use
/// for completion, and what schemas/ holds for the shipped plugins.
nlohmann::ordered_json pipeline_schema(const Registry& registry);

}  // namespace cambium
