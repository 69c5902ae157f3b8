// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

#include "cambium/plugin.hpp"

namespace cambium {

/// A component with its parameters (default, bounds, meaning) as a Markdown section.
std::string describe_markdown(const Registered& component);

/// Every component by kind: docs/reference.md.
std::string reference_markdown(const Registry& registry);

}  // namespace cambium
