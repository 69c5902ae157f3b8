// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/binder.hpp"
#include "plugins/loader.hpp"
#include "support/places.hpp"
#include "support/support.hpp"

namespace cambium::testing {
namespace {

// Opens only the library that the test needs: a build of one plugin can test that plugin.
const Registered& registered(Kind kind, const std::string& name) {
  static PluginLoader loader;
  if (const auto* known = loader.registry().find(kind, name)) return *known;
  const auto library = plugin_folder() / (name + ".so");
  if (std::filesystem::exists(library)) loader.load_file(library);
  if (!loader.registry().find(kind, name)) loader.load_folder(plugin_folder());
  if (const auto* found = loader.registry().find(kind, name)) return *found;
  std::string message = std::string("no ") + to_string(kind) + " of this name in " +
                        plugin_folder().string() + "; build its plugin first";
  for (const Error& refusal : loader.refusals()) message += std::string("\n  ") + refusal.what();
  throw Error(ErrorCode::plugin, name, message);
}

}  // namespace

std::shared_ptr<Component> component(Kind kind, const std::string& name, const std::string& yaml) {
  std::shared_ptr<Component> out = registered(kind, name).create();
  Diagnostics diagnostics;
  bind_params(*out, parse_yaml(yaml, name, diagnostics), diagnostics);
  diagnostics.throw_if_any();
  return out;
}

}  // namespace cambium::testing
