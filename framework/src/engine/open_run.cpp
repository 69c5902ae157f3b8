// SPDX-License-Identifier: BSD-3-Clause
#include "engine/open_run.hpp"

#include <set>

#include "cambium/error.hpp"
#include "engine/missions.hpp"
#include "engine/run_folder.hpp"
#include "engine/run_step.hpp"

namespace cambium {

namespace fs = std::filesystem;

bool is_run(const fs::path& folder) {
  return fs::exists(folder / "report.json") && fs::exists(folder / "resolved.yaml");
}

namespace {

Pipeline pipeline_of_run(const fs::path& run) {
  if (!is_run(run))
    throw Error(ErrorCode::config, run.string(),
                "holds no finished run (report.json and resolved.yaml); name the folder that "
                "'cambium run --out' wrote");
  return load_pipeline(run / "resolved.yaml");
}

}  // namespace

Pipeline filters_of_run(const fs::path& run) {
  Pipeline pipeline = pipeline_of_run(run);
  std::erase_if(pipeline.steps,
                [](const StepSpec& s) { return s.verb->kind != Kind::payload_filter; });
  return pipeline;
}

Pipeline missions_of_run(const fs::path& run) {
  Pipeline pipeline = pipeline_of_run(run);
  pipeline.steps.clear();
  return pipeline;
}

Atlas open_run(const fs::path& run, const Registry& registry, const Engine& engine) {
  return read_run(run, read_missions(missions_of_run(run), registry, engine));
}

Known reopen_run(const fs::path& run, const Registry& registry, const Engine& engine) {
  const ResolvedPipeline pipeline = resolve(filters_of_run(run), registry);
  Known known = known_missions(pipeline, registry, engine);
  known.atlas = read_run(run, std::move(known.atlas));
  for (const Step& step : pipeline.steps) run_step(step, known, engine, pipeline.spec.seed, run);
  return known;
}

std::vector<MissionSpec> without_runs(const std::vector<MissionSpec>& missions) {
  std::vector<MissionSpec> out;
  std::set<std::string> of_runs;
  for (const MissionSpec& spec : missions) {
    if (!is_run(spec.path)) {
      out.push_back(spec);
      continue;
    }
    for (const MissionSpec& part : missions_of_run(spec.path).missions)
      if (of_runs.insert(fs::weakly_canonical(part.path).string() + '\n' + part.name).second)
        out.push_back(part);
  }
  return out;
}

}  // namespace cambium
