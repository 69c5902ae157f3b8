// SPDX-License-Identifier: BSD-3-Clause
// Evaluators over a finished run.
#pragma once
#include "engine/steps.hpp"

namespace cambium {

struct EvaluationOptions {
  std::filesystem::path run;            ///< folder of a finished run
  std::filesystem::path truth;          ///< folder; empty: every mission brings its own
  std::vector<std::string> evaluators;  ///< names; empty: all
  std::vector<std::string> overrides;   ///< "ate.alignment=se3"
};

/// The filters of the run and then the evaluators; nothing has run yet.
ResolvedPipeline prepare_evaluation(const EvaluationOptions& options, const Registry& registry);

/// Reads the run's missions and map again, filters the payloads as the run did, so that figures are
/// those of an `evaluate` step at its end, and evaluates. One record an evaluator.
std::vector<StepRecord> evaluate_run(const EvaluationOptions& options,
                                     const ResolvedPipeline& pipeline, const Registry& registry,
                                     const Engine& engine);

}  // namespace cambium
