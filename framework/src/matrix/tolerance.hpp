// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>

#include "matrix/spec.hpp"

namespace cambium::matrix {

/// The tolerance that holds for a metric: the first pattern that fits, else the default one.
/// Nothing for times and memory that no pattern but "*" fits: another machine has others.
std::optional<Tolerance> tolerance_for(const Spec& spec, const std::string& metric);

}  // namespace cambium::matrix
