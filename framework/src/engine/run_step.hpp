// SPDX-License-Identifier: BSD-3-Clause
// One step of a pipeline: what runs and evaluations of finished runs have in common.
#pragma once
#include "engine/steps.hpp"

namespace cambium {

/// What is known before the first step: the missions, as they were read.
Known known_missions(const ResolvedPipeline& pipeline, const Registry& registry,
                     const Engine& engine);

/// Runs the step on the stream that it asks for and updates `known`. An error names the step.
StepRecord run_step(const Step& step, Known& known, const Engine& engine, std::uint64_t seed,
                    const std::filesystem::path& out, const Share* share = nullptr);

}  // namespace cambium
