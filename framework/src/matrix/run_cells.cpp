// SPDX-License-Identifier: BSD-3-Clause
#include "matrix/run_cells.hpp"

#include <fmt/format.h>

#include <map>

#include "matrix/datasets.hpp"
#include "matrix/runner.hpp"

namespace cambium::matrix {
namespace {

struct Prepared {
  std::vector<std::string> missions;
  Status status = Status::ok;
  std::string message;  ///< why it is not ok
};

// A dataset that cannot be prepared fails its own cells, not those of the others.
Prepared prepare_or_tell(const Dataset& dataset, const RunSettings& settings,
                         const Engine& engine) {
  const auto context = engine.context(digest_bytes(dataset.name), 0);
  Prepared out;
  try {
    out.missions = prepare(dataset, settings.out / "datasets" / dataset.name, *context);
    if (out.missions.empty()) out = {{}, Status::absent, "the dataset is not there"};
  } catch (const Cancelled&) {
    throw;
  } catch (const Error& e) {
    out = {{}, Status::failed, e.what()};
  }
  if (out.status != Status::ok)
    context->warn(fmt::format("the cells of '{}' are left out: {}", dataset.name, out.message));
  return out;
}

}  // namespace

std::vector<CellResult> run_cells(const Spec& spec, const std::vector<Cell>& cells,
                                  const RunSettings& settings, const Engine& engine) {
  std::filesystem::create_directories(settings.out / "cells");
  std::map<std::string, Prepared> datasets;
  for (const Dataset& d : spec.datasets)
    datasets.emplace(d.name, prepare_or_tell(d, settings, engine));
  std::vector<CellResult> results;
  std::vector<Job> jobs;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    results.push_back({cells[i].name, cells[i].choices, {}});
    const Prepared& dataset = datasets.at(results[i].dataset());
    if (dataset.status != Status::ok)
      results[i].runs.push_back({0, dataset.status, dataset.message, 0, {}});
    for (int k = 0; k < spec.repeat && dataset.status == Status::ok; ++k)
      jobs.push_back(make_job(cells[i], i, dataset.missions,
                              cells[i].pipeline.spec.seed + std::uint64_t(k), settings));
  }
  const auto runs = Runner(jobs, spec.time_limit, settings, engine).run();
  for (std::size_t j = 0; j < jobs.size(); ++j) results[jobs[j].cell].runs.push_back(runs[j]);
  return results;
}

}  // namespace cambium::matrix
