// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "pipeline/pipeline.hpp"

namespace cambium {

/// Checks that every step finds what it needs: candidates to register, loops to verify, streams of
/// payloads that were written. Before anything runs.
void check_wiring(const Pipeline& pipeline, Diagnostics& diagnostics);

}  // namespace cambium
