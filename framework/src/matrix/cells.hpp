// SPDX-License-Identifier: BSD-3-Clause
// The cells of a matrix: every combination of the axes on every dataset.
#pragma once
#include "engine/resolve.hpp"
#include "matrix/spec.hpp"

namespace cambium::matrix {

struct Cell {
  std::string name;                                          ///< "scan_context+gicp+ceres@forest"
  std::vector<std::pair<std::string, std::string>> choices;  ///< axis -> value, "dataset" last
  ResolvedPipeline pipeline;                                 ///< without missions
};

/// In the order of the file: datasets, then the last axis runs fastest. Without those excluded.
/// Throws Error(config) with every value of an axis that does not fit the base pipeline.
std::vector<Cell> make_cells(const Spec& spec, const Registry& registry);

}  // namespace cambium::matrix
