// SPDX-License-Identifier: BSD-3-Clause
// A matrix or a batch from its file to its folder.
#pragma once
#include "matrix/judge.hpp"
#include "matrix/run_cells.hpp"

namespace cambium::matrix {

/// Runs and judges all cells and writes results.json, results.md, junit.xml and index.html. With
/// `update_baseline` the baseline is written instead of being compared with. Refuses a folder that
/// holds something else.
Results run_study(const Spec& spec, const Registry& registry, const RunSettings& settings,
                  const Engine& engine, bool update_baseline);

/// Runs the `index`-th of `count` parts of the cells (from 1) into the cache and judges nothing.
std::vector<CellResult> run_study_shard(const Spec& spec, const Registry& registry,
                                        const RunSettings& settings, const Engine& engine,
                                        std::size_t index, std::size_t count);

}  // namespace cambium::matrix
