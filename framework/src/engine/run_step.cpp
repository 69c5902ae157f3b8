// SPDX-License-Identifier: BSD-3-Clause
#include "engine/run_step.hpp"

#include <fmt/format.h>

#include <chrono>

#include "engine/copies.hpp"
#include "engine/keys.hpp"
#include "engine/missions.hpp"
#include "pipeline/params.hpp"

namespace cambium {
namespace {

KeyParts key_parts(const Step& step, const Known& known, const Engine& engine, std::uint64_t seed) {
  StepKeys keys = step.keys;
  KeyParts parts = {{"program", engine.build().hex()},
                    {"plugin", step.registered->build.hex()},
                    {"params", step.configured.params},
                    {"files", step.configured.key.hex()},  // of those that parameters name
                    {"step", canonical_params(keys)},
                    {"seed", std::to_string(seed)}};
  for (const auto& [id, c] : step.by_platform)
    parts.emplace_back(fmt::format("params of platform {}", id), c.params);
  for (const auto& [part, digest] : atlas_key_parts(known.atlas))
    parts.emplace_back(part, digest.hex());
  return parts;
}

}  // namespace

StepRecord run_step(const Step& step, Known& known, const Engine& engine, std::uint64_t seed,
                    const std::filesystem::path& out, const Share* share) try {
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

Known known_missions(const ResolvedPipeline& pipeline, const Registry& registry,
                     const Engine& engine) {
  Known known;
  known.atlas = read_missions(pipeline.spec, registry, engine);
  refuse_shared_payloads(known.atlas, engine);
  known.streams["main"] = known.atlas.payloads;
  return known;
}

}  // namespace cambium
