// SPDX-License-Identifier: BSD-3-Clause
#include "matrix/job.hpp"

#include <fmt/format.h>

#include <cstring>
#include <sstream>

#include "cambium/files.hpp"
#include "engine/program.hpp"
#include "pipeline/params.hpp"

namespace cambium::matrix {
namespace {

// Two cells share what they cached for as long as these texts are equal.
Steps steps_of(const ResolvedPipeline& pipeline, const std::string& dataset) {
  Steps out;
  for (const Step& step : pipeline.steps) {
    StepKeys keys = step.keys;
    std::string text = fmt::format("{} {} {} {} {}", dataset, pipeline.spec.seed, step.title(),
                                   step.configured.key.hex(), canonical_params(keys));
    for (const auto& [id, c] : step.by_platform) text += fmt::format(" {}:{}", id, c.key.hex());
    out.push_back(std::move(text));
  }
  return out;
}

std::string last_error(const std::filesystem::path& log) {
  std::istringstream lines(read_file(log));
  std::string last;
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("error: ")) last = line.substr(7);
  return last;
}

void add_report(const std::filesystem::path& file, std::size_t peak_memory, CellRun& run) {
  const Json report = Json::parse(read_file(file));
  for (const Json& m : report.at("metrics")) run.metrics.push_back(read_metric(m));
  double work = 0;
  for (const Json& step : report.at("steps")) work += step.at("work_seconds").get<double>();
  run.metrics.push_back({"time.work", work, "s", Better::lower});
  run.metrics.push_back({"memory.peak", double(peak_memory) / (1 << 20), "MB", Better::lower});
}

}  // namespace

Job make_job(const Cell& cell, std::size_t index, const std::vector<std::string>& missions,
             std::uint64_t seed, const RunSettings& settings) {
  const std::uint64_t first = cell.pipeline.spec.seed;
  ResolvedPipeline pipeline = cell.pipeline;
  pipeline.spec.seed = seed;
  pipeline.spec.missions.clear();
  for (const std::string& m : missions) {  // a pipeline's own paths count from where it lies
    const std::string path = std::filesystem::absolute(m).lexically_normal().string();
    pipeline.spec.missions.push_back({path, "", "", {}, path});
  }
  Job job{index, seed, cell.name, steps_of(pipeline, cell.choices.back().second), {}, {}, {}};
  if (seed != first) job.name += fmt::format(".seed{}", seed);
  job.out = settings.out / "cells" / job.name;
  job.log = job.out.string() + ".log";
  const std::string file = job.out.string() + ".yaml";
  write_file(file, to_yaml(pipeline));
  job.command = {program_path().string(),
                 "run",
                 file,
                 "--out",
                 job.out.string(),
                 "--cache",
                 settings.engine.cache ? settings.engine.cache->string() : "none"};
  for (const std::string& path : settings.plugin_path)
    job.command.insert(job.command.end(), {"--plugin-path", path});
  return job;
}

CellRun read_job(const Job& job, const Child::Outcome& outcome) {
  CellRun run;
  run.seed = job.seed;
  run.seconds = outcome.seconds;
  if (outcome.timed_out) {
    run.status = Status::timed_out;
    run.message = fmt::format("stopped after {:.0f} s", outcome.seconds);
  } else if (outcome.signal != 0) {
    run.status = Status::crashed;
    run.message =
        fmt::format("ended by signal {} ({})", outcome.signal, ::strsignal(outcome.signal));
  } else if (outcome.exit_code != 0) {
    run.status = Status::failed;
    run.message = fmt::format("exit code {}: {}", outcome.exit_code, last_error(job.log));
  } else {
    add_report(job.out / "report.json", outcome.peak_memory, run);
  }
  if (run.status != Status::ok) run.message += "; see " + job.log.string();
  return run;
}

}  // namespace cambium::matrix
