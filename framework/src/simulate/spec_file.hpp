// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <filesystem>

#include <nlohmann/json.hpp>

#include "simulate/spec.hpp"

namespace cambium::simulate {

/// Reads a specification. Throws Error(config) with every mistake as file:line:col.
SimulationSpec load_spec(const std::filesystem::path& file);
SimulationSpec parse_spec(const std::string& text, const std::string& file);

/// JSON Schema (draft 7) of such a file: schemas/simulate.schema.json.
nlohmann::ordered_json spec_schema();

}  // namespace cambium::simulate
