// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <nlohmann/json.hpp>

#include "cambium/plugin.hpp"

namespace cambium::matrix {

/// JSON Schema (draft 7) of a matrix file, with the components of the registry as values of axes.
/// A batch is a matrix without axes, exclude, baseline and tolerances.
nlohmann::ordered_json matrix_schema(const Registry& registry);

}  // namespace cambium::matrix
