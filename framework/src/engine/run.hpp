// SPDX-License-Identifier: BSD-3-Clause
// A pipeline from YAML to run folder.
#pragma once
#include "engine/report.hpp"
#include "engine/share.hpp"

namespace cambium {

struct RunOptions {
  std::filesystem::path pipeline;
  std::vector<std::string> missions;   ///< replace those of the pipeline when not empty
  std::vector<std::string> overrides;  ///< "optimize.loss=huber"
  std::optional<std::uint64_t> seed;
  std::filesystem::path out;
  bool explain = false;  ///< say for every step why it ran again
};

struct RunResult {
  Known known;
  std::vector<StepRecord> steps;
  Json report;
};

/// The pipeline with the options applied, its plugins found. Nothing has run yet.
ResolvedPipeline prepare_run(const RunOptions& options, const Registry& registry);

/// Runs it and writes the run folder. Refuses a folder that holds something else.
RunResult run_pipeline(const RunOptions& options, const ResolvedPipeline& pipeline,
                       const Registry& registry, const Engine& engine);

/// Computes the share of a wave into the cache: the steps before the wave as in run_pipeline, then
/// of the wave's own steps only the share, and nothing after it. Writes no run folder.
std::vector<StepRecord> run_share(const ResolvedPipeline& pipeline, const Share& share,
                                  const Registry& registry, const Engine& engine);

}  // namespace cambium
