// SPDX-License-Identifier: BSD-3-Clause
#include "engine/export_run.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "engine/open_run.hpp"
#include "engine/run_step.hpp"

namespace cambium {

namespace fs = std::filesystem;

std::string page_exporter(const std::string& name, const Registry& registry) {
  std::vector<std::string> found;
  for (const auto& [key, registered] : registry.all()) {
    if (key.first != Kind::map_exporter) continue;
    const auto component = registered.create();
    if (!dynamic_cast<const MapExporter&>(*component).start_page().empty())
      found.push_back(key.second);
  }
  if (!name.empty()) {
    if (std::find(found.begin(), found.end(), name) != found.end()) return name;
    throw Error(ErrorCode::config, "--exporter " + name,
                fmt::format("is no exporter that makes a page; these are: {}",
                            found.empty() ? "none" : fmt::format("{}", fmt::join(found, ", "))));
  }
  if (found.size() == 1) return found.front();
  if (found.empty())
    throw Error(ErrorCode::config, "",
                "no plugin here makes a page; was Cambium built without Node.js? "
                "'./bootstrap view' installs it. The run's report.html needs no server");
  throw Error(ErrorCode::config, "",
              fmt::format("several exporters make a page ({}); choose one with --exporter",
                          fmt::join(found, ", ")));
}

void export_run(const fs::path& run, const std::string& exporter, const Registry& registry,
                const Engine& engine) {
  Pipeline pipeline = missions_of_run(run);
  pipeline.steps =
      parse_pipeline("version: 1\nsteps: [{export: " + exporter + "}]\n", "command line", {}).steps;
  Known known = reopen_run(run, registry, engine);
  for (const Step& step : resolve(pipeline, registry).steps)
    run_step(step, known, engine, pipeline.seed, run);
}

}  // namespace cambium
