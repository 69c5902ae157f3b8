// SPDX-License-Identifier: BSD-3-Clause
// What evaluators found, as a user reads it.
#pragma once
#include <string>

#include "engine/steps.hpp"

namespace cambium::cli {

/// One row for each evaluator, its first metric, and one column for each label: before and after.
std::string headline_table(const std::vector<StepRecord>& steps);

/// Every metric, one a line.
std::string full_table(const std::vector<StepRecord>& steps);

}  // namespace cambium::cli
