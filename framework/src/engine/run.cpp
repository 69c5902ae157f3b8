// SPDX-License-Identifier: BSD-3-Clause
#include "engine/run.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cambium/dialect.hpp"
#include "cambium/files.hpp"
#include "cambium/fused.hpp"
#include "engine/explain.hpp"
#include "engine/memory_use.hpp"
#include "engine/open_run.hpp"
#include "engine/output_folder.hpp"
#include "engine/run_step.hpp"
#include "report/page.hpp"

namespace cambium {
namespace {

namespace fs = std::filesystem;

void warn_of_islands(const Atlas& atlas, Progress& progress) {
  if (atlas.islands.size() < 2) return;
  std::string text =
      fmt::format("{} islands: no accepted loop ties them together:", atlas.islands.size());
  for (const auto& island : atlas.islands) {
    text += " {";
    for (std::size_t i = 0; i < island.missions.size(); ++i)
      text += (i ? ", " : "") + atlas.missions[island.missions[i]].mission->name;
    text += "}";
  }
  progress.log(LogLevel::warning, text + "; each has a map frame of its own");
}

// Between two looks at memory a step may take more than it leaves behind.
void warn_of_peak(const Engine& engine) {
  if (peak_bytes() <= engine.memory()) return;
  engine.progress().log(
      LogLevel::warning,
      fmt::format("the run took {} at its peak, more than --memory {}; allow as much, use fewer "
                  "threads, or fuse fewer missions at once",
                  shown_bytes(peak_bytes()), shown_bytes(engine.memory())));
}

void write_maps(const Atlas& atlas, const fs::path& out) {
  for (std::size_t i = 0; i < atlas.islands.size(); ++i) {
    AtomicFile file(out / island_file("fused", i, ".g2o"));
    write_g2o(file.stream(), fused_mission(atlas, atlas.islands[i]));
    file.commit();
  }
  for (const auto& state : atlas.missions)
    write_file(out / (state.mission->name + ".tum"), format_tum(trajectory(state)));
}

}  // namespace

ResolvedPipeline prepare_run(const RunOptions& options, const Registry& registry) {
  Pipeline p = load_pipeline(options.pipeline, options.overrides);
  if (options.seed) p.seed = *options.seed;
  if (!options.missions.empty()) p.missions.clear();
  // Absolute, as those of a file: resolved.yaml lies elsewhere and must mean the same missions.
  for (const auto& m : options.missions)
    p.missions.push_back({fs::absolute(m).lexically_normal().string(), "", "", {}, "command line"});
  p.missions = without_runs(p.missions);
  return resolve(p, registry);
}

RunResult run_pipeline(const RunOptions& options, const ResolvedPipeline& pipeline,
                       const Registry& registry, const Engine& engine) {
  open_output_folder(options.out, "resolved.yaml", "a run");
  const Explainer explainer(options.out / "report.json");
  Progress& progress = engine.progress();
  const std::string resolved = to_yaml(pipeline);
  write_file(options.out / "resolved.yaml", resolved);

  RunResult result;
  Known& known = result.known;
  known = known_missions(pipeline, registry, engine);
  for (const Step& step : pipeline.steps) {
    result.steps.push_back(run_step(step, known, engine, pipeline.spec.seed, options.out));
    if (options.explain)
      progress.log(LogLevel::info, explainer.explain(result.steps.size() - 1, result.steps.back()));
  }
  known.atlas.payloads = known.streams.at("main");
  warn_of_islands(known.atlas, progress);
  warn_of_peak(engine);
  write_maps(known.atlas, options.out);
  write_file(options.out / "ledger.jsonl", ledger_jsonl(known.atlas));
  result.report = report_json(known, result.steps, progress.warnings());
  result.report["memory"] = {{"budget", engine.memory()}, {"peak", peak_bytes()}};
  write_file(options.out / "report.html", report_page(known.atlas, result.report, resolved));
  write_file(options.out / "report.json", result.report.dump(1) + "\n");
  return result;
}

std::vector<StepRecord> run_share(const ResolvedPipeline& pipeline, const Share& share,
                                  const Registry& registry, const Engine& engine) {
  const auto waves = waves_of(pipeline);
  const auto last = std::find(waves.rbegin(), waves.rend(), share.wave);
  if (share.wave == 0 || last == waves.rend())
    throw Error(ErrorCode::config, "--wave",
                fmt::format("the pipeline has no wave {}", share.wave));
  std::vector<StepRecord> records;
  Known known = known_missions(pipeline, registry, engine);
  for (std::size_t i = 0; i < std::size_t(waves.rend() - last); ++i) {
    const Step& step = pipeline.steps[i];
    // These read the map and change nothing in it.
    if (step.verb->kind == Kind::map_exporter || step.verb->kind == Kind::evaluator) continue;
    records.push_back(run_step(step, known, engine, pipeline.spec.seed, {},
                               waves[i] == share.wave ? &share : nullptr));
  }
  return records;
}

}  // namespace cambium
