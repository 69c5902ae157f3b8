// SPDX-License-Identifier: BSD-3-Clause
// Opens every payload once to say what is wrong with it before a long run does.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "cambium/context.hpp"

namespace cambium {

struct PayloadPaths {
  std::filesystem::path cloud, trees, image;  ///< empty: none
};

void check_payloads(const std::vector<PayloadPaths>& nodes, bool apply_viewpoint,
                    const Context& context, std::vector<std::string>& warnings);

}  // namespace cambium
