// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "engine/engine.hpp"
#include "matrix/cells.hpp"
#include "matrix/results.hpp"

namespace cambium::matrix {

struct RunSettings {
  std::filesystem::path out;  ///< gets datasets/, and for each cell cells/NAME{.yaml,.log,/}
  std::size_t jobs = 0;       ///< cells side by side; 0 = as many as have threads and memory
  EngineOptions engine;       ///< its memory is split evenly, its threads as cells need them
  std::vector<std::string> plugin_path;
};

/// Runs every cell as `cambium run` in a process of its own. A cell that fails, crashes or takes
/// longer than the limit is one that says so; the rest go on. Throws Cancelled when interrupted.
std::vector<CellResult> run_cells(const Spec& spec, const std::vector<Cell>& cells,
                                  const RunSettings& settings, const Engine& engine);

}  // namespace cambium::matrix
