// SPDX-License-Identifier: BSD-3-Clause
#include "cambium/plugin.hpp"

namespace cambium {

void Registry::add(Registered component) {
  const auto key = std::make_pair(component.kind, component.name);
  const auto [it, inserted] = components_.try_emplace(key, component);
  if (!inserted)
    throw Error(ErrorCode::plugin, component.library,
                std::string("the ") + to_string(component.kind) + " '" + component.name +
                    "' is already provided by " +
                    (it->second.library.empty() ? "another plugin" : it->second.library) +
                    "; rename one of them, or take one library out of the plugin path");
}

const Registered* Registry::find(Kind kind, const std::string& name) const {
  const auto it = components_.find({kind, name});
  return it == components_.end() ? nullptr : &it->second;
}

}  // namespace cambium
