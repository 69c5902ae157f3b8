// SPDX-License-Identifier: BSD-3-Clause
#include "engine/open_run.hpp"

#include <set>

#include "cambium/error.hpp"
#include "engine/missions.hpp"
#include "engine/run_folder.hpp"

namespace cambium {

namespace fs = std::filesystem;

bool is_run(const fs::path& folder) {
  return fs::exists(folder / "report.json") && fs::exists(folder / "resolved.yaml");
}

Pipeline missions_of_run(const fs::path& run) {
  if (!is_run(run))
    throw Error(ErrorCode::config, run.string(),
                "holds no finished run (report.json and resolved.yaml); name the folder that "
                "'cambium run --out' wrote");
  Pipeline pipeline = load_pipeline(run / "resolved.yaml");
  pipeline.steps.clear();
  return pipeline;
}

Atlas open_run(const fs::path& run, const Registry& registry, const Engine& engine) {
  return read_run(run, read_missions(missions_of_run(run), registry, engine));
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
