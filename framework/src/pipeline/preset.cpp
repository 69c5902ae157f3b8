// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/preset.hpp"

#include "pipeline/binder.hpp"
#include "pipeline/overrides.hpp"

namespace cambium {
namespace {

Yaml params_of(const std::vector<std::string>& settings, Diagnostics& diagnostics) {
  Yaml params;
  for (const std::string& text : settings)
    if (const auto s = parse_setting(text, "PARAM=VALUE", diagnostics))
      params.set(s->name, s->value);
  return params;
}

}  // namespace

Registered preset(Registered component, std::vector<std::string> settings) {
  if (settings.empty()) return component;
  component.create = [plain = component.create, settings = std::move(settings)] {
    Diagnostics diagnostics;
    auto made = plain();
    bind_params(*made, params_of(settings, diagnostics), diagnostics);
    diagnostics.throw_if_any();
    return made;
  };
  return component;
}

}  // namespace cambium
