// SPDX-License-Identifier: BSD-3-Clause
// Datasets as missions on disk.
#pragma once
#include "cambium/context.hpp"
#include "matrix/spec.hpp"

namespace cambium::matrix {

/// The missions of the dataset. Those to simulate or to unpack are written to `folder`, unless it
/// holds them already from the same specification and program, or from the same archive. Empty when
/// an optional dataset is absent. Throws Error(config) when one is absent that is not optional.
std::vector<std::string> prepare(const Dataset& dataset, const std::filesystem::path& folder,
                                 const Context& context);

}  // namespace cambium::matrix
