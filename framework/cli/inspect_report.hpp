// SPDX-License-Identifier: BSD-3-Clause
// An inspection as text for people and as JSON for programs.
#pragma once
#include <string>

#include "engine/inspection.hpp"

namespace cambium::cli {

std::string inspection_text(const Mission& mission, const Inspection& inspection);
std::string inspection_json(const Mission& mission, const Inspection& inspection);

}  // namespace cambium::cli
