// SPDX-License-Identifier: BSD-3-Clause
// What the fixtures share: a component, and a trace of any code that runs.
#pragma once
#include <cstdlib>

#include "cambium/plugin.hpp"

namespace fixture {

/// Gives back the payload as it is.
class Unchanged final : public cambium::PayloadFilter {
 public:
  cambium::Payload apply(const cambium::MissionView& mission, std::size_t node,
                         const cambium::Context&) const override {
    return mission.payload(node);
  }
};

/// A global of this type shows that the library was opened: its constructor sets the variable.
struct LeavesTrace {
  explicit LeavesTrace(const char* variable) { ::setenv(variable, "opened", 1); }
};

/// A descriptor with another version of the API than that of this tree.
constexpr cambium::PluginDescriptor with_api(std::uint32_t major, std::uint32_t minor,
                                             void (*fill)(cambium::Registry&)) {
  return {sizeof(cambium::PluginDescriptor),
          major,
          minor,
          cambium::this_abi(),
          "other_api",
          "1.0.0",
          fill};
}

}  // namespace fixture

#define FIXTURE_EXPORT extern "C" __attribute__((visibility("default")))
