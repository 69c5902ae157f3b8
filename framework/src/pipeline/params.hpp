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

/// A text parameter in_unit("file") names a file, relative to the pipeline or whatever else names it;
/// empty: none. The component gets an absolute path of a file that is there, and the cache key the
/// digest of its content. One in_unit("script") also declares further parameters, which the component
/// visits behind it as soon as it knows the file; its digest is that of pipeline/script_files.hpp.
bool is_file(const Constraint& constraint);
bool declares_more(const Constraint& constraint);

std::vector<ParamInfo> list_params(Component& component);

/// One line of YAML with every value in the order of declaration, numbers bit for bit. Part of the
/// cache key, and what resolved.yaml shows.
std::string canonical_params(Component& component);
inline std::string canonical_params(Component&& component) { return canonical_params(component); }

/// The same for the cache key: files by the digests of their contents, wherever they lie.
std::string identifying_params(Component& component);

/// JSON Schema of the `params` map.
nlohmann::ordered_json params_schema(Component& component);

}  // namespace cambium
