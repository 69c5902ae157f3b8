// SPDX-License-Identifier: BSD-3-Clause
// What must hold: the expectations of the file, and no metric worse than in the baseline.
#pragma once
#include "matrix/results.hpp"
#include "matrix/spec.hpp"

namespace cambium::matrix {

/// Cell -> metric -> value.
using Baseline = std::map<std::string, std::map<std::string, double>>;

/// Throws Error(config) when the file is not there.
Baseline read_baseline(const std::filesystem::path& file);

/// The medians of every cell that ran. Of times and memory only what a tolerance names: they are
/// those of one machine. `before` keeps the cells of datasets that are not there today.
std::string format_baseline(const Spec& spec, const std::vector<CellResult>& cells,
                            const Baseline& before);

/// Failures of cells, then what misses the expectations, then what differs from the baseline.
std::vector<Finding> judge(const Spec& spec, const std::vector<CellResult>& cells,
                           const Baseline* baseline);

}  // namespace cambium::matrix
