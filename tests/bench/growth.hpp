// SPDX-License-Identifier: BSD-3-Clause
// Time and memory of solvers as the graph grows.
#pragma once
#include <string>
#include <utility>
#include <vector>

namespace cambium::testing {

/// One table: generated grids of 1000 to 100,000 poses, every solver (name, parameters as YAML) on
/// each, in a process of its own, so that its peak of memory is its own.
void bench_growth(const std::vector<std::pair<std::string, std::string>>& solvers);

}  // namespace cambium::testing
