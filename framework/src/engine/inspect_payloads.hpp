// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "engine/inspection.hpp"

namespace cambium {

/// Payloads that cannot be read go to `findings`, unless the reader has said it already.
PayloadFigures inspect_payloads(const Mission& mission, const ParallelFor& parallel_for,
                                std::vector<std::string>& findings);

}  // namespace cambium
