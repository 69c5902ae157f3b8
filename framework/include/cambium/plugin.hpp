// SPDX-License-Identifier: BSD-3-Clause
// All that a plugin includes. See docs/write-a-plugin.md.
#pragma once
#include <functional>
#include <map>
#include <memory>
#include <string>

#include "cambium/abi.hpp"
#include "cambium/kinds.hpp"

namespace cambium {

/// One component that can be named in a pipeline.
struct Registered {
  Kind kind;
  std::string name;
  std::string summary;  ///< one line for `cambium plugins list`
  std::string plugin, plugin_version, library;  ///< filled in by the loader
  Digest build;                                 ///< of the library's file
  std::function<std::unique_ptr<Component>()> create;
};

/// Where plugins put their components.
class Registry {
 public:
  /// Throws Error(plugin) when a component of that kind and name exists already.
  template <class T>
  void add(const std::string& name, const std::string& summary) {
    add(Registered{T::kind, name, summary, {}, {}, {}, {}, [] { return std::make_unique<T>(); }});
  }
  void add(Registered component);
  const Registered* find(Kind kind, const std::string& name) const;  ///< null when unknown
  const std::map<std::pair<Kind, std::string>, Registered>& all() const { return components_; }

 private:
  std::map<std::pair<Kind, std::string>, Registered> components_;
};

}  // namespace cambium

/// CAMBIUM_PLUGIN("ring-key", "1.0.0") { registry.add<RingKey>("ring_key", "..."); }
/// The descriptor is data, not a function: the host reads it before it runs anything of the plugin.
#define CAMBIUM_PLUGIN(NAME, VERSION)                                                            \
  static void cambium_fill(cambium::Registry& registry);                                         \
  extern "C" __attribute__((visibility("default"))) const cambium::PluginDescriptor cambium_plugin; \
  const cambium::PluginDescriptor cambium_plugin = {sizeof(cambium::PluginDescriptor),           \
                                                    cambium::api_major,                          \
                                                    cambium::api_minor,                          \
                                                    cambium::this_abi(),                         \
                                                    NAME,                                        \
                                                    VERSION,                                     \
                                                    &cambium_fill};                              \
  static void cambium_fill([[maybe_unused]] cambium::Registry& registry)
