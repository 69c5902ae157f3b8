// SPDX-License-Identifier: BSD-3-Clause
// Which cells `exclude` and `where` mean.
#pragma once
#include "matrix/spec.hpp"

namespace cambium::matrix {

bool contains(const std::vector<std::string>& list, const std::string& value);

/// A map such as {register: gicp, dataset: [a, b]}. Unknown axes and values go to `diagnostics`.
Selection parse_selection(const Yaml& yaml, const Spec& spec, Diagnostics& diagnostics);

/// `choices`: the value of each axis by its name, and that of "dataset".
bool selects(const Selection& selection,
             const std::vector<std::pair<std::string, std::string>>& choices);

}  // namespace cambium::matrix
