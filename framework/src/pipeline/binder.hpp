// SPDX-License-Identifier: BSD-3-Clause
// Sets the parameters of a component from a YAML map.
#pragma once
#include "cambium/kinds.hpp"
#include "pipeline/yaml.hpp"

namespace cambium {

/// Unknown keys, wrong types and broken bounds go to `diagnostics`; the component keeps its
/// defaults for those.
void bind_params(Component& component, const Yaml& params, Diagnostics& diagnostics);

/// Empty when `value` satisfies the constraint, else "must be above 0 m, found -1".
std::string violation(double value, const Constraint& constraint);

/// "0 < value <= 10 m", or "one of a, b"; empty when anything goes.
std::string to_text(const Constraint& constraint);

}  // namespace cambium
