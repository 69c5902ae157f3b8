// SPDX-License-Identifier: BSD-3-Clause
#include "engine/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "cambium/dialect.hpp"
#include "cambium/files.hpp"
#include "cambium/fused.hpp"
#include "engine/explain.hpp"
#include "engine/keys.hpp"
#include "engine/missions.hpp"
#include "io/temporary.hpp"
#include "pipeline/params.hpp"

namespace cambium {
namespace {

namespace fs = std::filesystem;

void open_run_folder(const fs::path& out) {
  if (out.empty())
    throw Error(ErrorCode::config, "--out", "no folder was named to write the run to");
  if (fs::exists(out) && !fs::is_directory(out))
    throw Error(ErrorCode::config, out.string(), "is a file; --out must name a folder");
  if (fs::exists(out) && !fs::is_empty(out) && !fs::exists(out / "resolved.yaml"))
    throw Error(ErrorCode::config, out.string(),
                "holds something that is not a run of Cambium; choose an empty or new folder");
  std::error_code error;
  fs::create_directories(out, error);
  if (error) throw Error(ErrorCode::data, out.string(), "cannot be made: " + error.message());
  remove_orphans(out);
}

KeyParts key_parts(const Step& step, const Known& known, const Engine& engine, std::uint64_t seed) {
  StepKeys keys = step.keys;
  KeyParts parts = {{"program", engine.build().hex()},
                    {"plugin", step.registered->build.hex()},
                    {"params", step.configured.params},
                    {"step", canonical_params(keys)},
                    {"seed", std::to_string(seed)}};
  for (const auto& [id, c] : step.by_platform)
    parts.emplace_back(fmt::format("params of platform {}", id), c.params);
  for (const auto& [part, digest] : atlas_key_parts(known.atlas))
    parts.emplace_back(part, digest.hex());
  return parts;
}

StepRecord run_step(const Step& step, Known& known, const Engine& engine, std::uint64_t seed,
                    const fs::path& out, const Share* share = nullptr) try {
  StepRecord record;
  record.verb = step.verb->word;
  record.plugin = step.plugin;
  record.label = step.keys.label;
  // Steps see the stream that they ask for; only filters change the streams themselves.
  known.atlas.payloads = known.streams.at(step.keys.payload);
  record.key = key_parts(step, known, engine, seed);
  const auto begin = std::chrono::steady_clock::now();
  engine.progress().begin(step.title());
  known =
      step_function(step.verb->kind)(std::move(known), {step, engine, seed, out, record, share});
  record.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  if (record.items > 0 && record.cached == record.items) record.summary += " (cached)";
  engine.progress().end(record.summary);
  return record;
} catch (const Cancelled&) {
  throw;
} catch (const Error& e) {
  throw Error(e.code(), e.where(),
              fmt::format("{} (in step '{}', {})", e.message(), step.title(), step.where));
}

Known read(const ResolvedPipeline& pipeline, const Registry& registry, const Engine& engine) {
  Known known;
  known.atlas = read_missions(pipeline.spec, registry, engine);
  known.streams["main"] = known.atlas.payloads;
  return known;
}

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

void write_maps(const Atlas& atlas, const fs::path& out) {
  for (std::size_t i = 0; i < atlas.islands.size(); ++i) {
    AtomicFile file(out / (i == 0 ? "fused.g2o" : fmt::format("fused_island_{}.g2o", i)));
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
  return resolve(p, registry);
}

RunResult run_pipeline(const RunOptions& options, const ResolvedPipeline& pipeline,
                       const Registry& registry, const Engine& engine) {
  open_run_folder(options.out);
  const Explainer explainer(options.out / "report.json");
  Progress& progress = engine.progress();
  write_file(options.out / "resolved.yaml", to_yaml(pipeline));

  RunResult result;
  Known& known = result.known;
  known = read(pipeline, registry, engine);
  for (const Step& step : pipeline.steps) {
    result.steps.push_back(run_step(step, known, engine, pipeline.spec.seed, options.out));
    if (options.explain)
      progress.log(LogLevel::info, explainer.explain(result.steps.size() - 1, result.steps.back()));
  }
  known.atlas.payloads = known.streams.at("main");
  warn_of_islands(known.atlas, progress);
  write_maps(known.atlas, options.out);
  write_file(options.out / "ledger.jsonl", ledger_jsonl(known.atlas));
  result.report = report_json(known, result.steps, progress.warnings());
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
  Known known = read(pipeline, registry, engine);
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
