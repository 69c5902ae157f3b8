// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "matrix/spec.hpp"

namespace cambium::matrix {

/// One entry of `axes:`, such as `register: [gicp, {plugin: ndt, params: {...}}]`. Mistakes go to
/// `diagnostics`; nothing when the key is no verb.
std::optional<Axis> parse_axis(const Yaml& key, const Yaml& values, const Pipeline& base,
                               Diagnostics& diagnostics);

/// Names of datasets and of values become folders, and parts of cell names ("a+b@dataset").
void check_name(const std::string& name, const std::string& where, Diagnostics& diagnostics);

}  // namespace cambium::matrix
