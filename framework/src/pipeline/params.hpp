// SPDX-License-Identifier: BSD-3-Clause
// What can be read off a component's params(): a list, a canonical text, a JSON Schema.
#pragma once
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "cambium/kinds.hpp"

namespace cambium {

struct ParamInfo {
  std::string name, type, doc;
  nlohmann::ordered_json value;  ///< the default, for a fresh component
  Constraint constraint;
};

std::vector<ParamInfo> list_params(Component& component);

/// One line of YAML with every value in the order of declaration, numbers bit for bit. Part of the
/// cache key, and what resolved.yaml shows.
std::string canonical_params(Component& component);
inline std::string canonical_params(Component&& component) { return canonical_params(component); }

/// JSON Schema of the `params` map.
nlohmann::ordered_json params_schema(Component& component);

}  // namespace cambium
