// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "cambium/files.hpp"
#include "matrix/results.hpp"

namespace cambium::matrix {
namespace {

Json run_json(const CellRun& run) {
  Json metrics = Json::array();
  for (const Metric& m : run.metrics) metrics.push_back(metric_json(m));
  return {{"seed", run.seed},
          {"status", to_string(run.status)},
          {"message", run.message},
          {"seconds", run.seconds},
          {"metrics", metrics}};
}

Json cell_json(const CellResult& cell) {
  Json choices = Json::object(), runs = Json::array();
  for (const auto& [axis, value] : cell.choices) choices[axis] = value;
  for (const CellRun& run : cell.runs) runs.push_back(run_json(run));
  return {{"name", cell.name},
          {"choices", choices},
          {"status", to_string(cell.status())},
          {"runs", runs}};
}

CellRun read_run(const Json& json) {
  CellRun run;
  run.seed = json.at("seed");
  for (const Status s :
       {Status::ok, Status::failed, Status::crashed, Status::timed_out, Status::absent})
    if (json.at("status") == to_string(s)) run.status = s;
  run.message = json.at("message");
  run.seconds = json.at("seconds");
  for (const Json& m : json.at("metrics")) run.metrics.push_back(read_metric(m));
  return run;
}

}  // namespace

Json to_json(const Results& results) {
  Json cells = Json::array(), findings = Json::array();
  for (const CellResult& cell : results.cells) cells.push_back(cell_json(cell));
  for (const Finding& f : results.findings)
    findings.push_back({{"kind", to_string(f.kind)},
                        {"bad", f.bad()},
                        {"cell", f.cell},
                        {"metric", f.metric},
                        {"text", f.text}});
  return {{"title", results.title},
          {"passed", results.passed()},
          {"metrics", results.metrics},
          {"findings", findings},
          {"cells", cells}};
}

Results read_results(const std::filesystem::path& path) {
  const auto file = std::filesystem::is_directory(path) ? path / "results.json" : path;
  Results out;
  try {
    const Json json = Json::parse(read_file(file));
    out.title = json.at("title");
    out.metrics = json.at("metrics").get<std::vector<std::string>>();
    for (const Json& c : json.at("cells")) {
      CellResult& cell = out.cells.emplace_back();
      cell.name = c.at("name");
      for (const auto& [axis, value] : c.at("choices").items())
        cell.choices.emplace_back(axis, value);
      for (const Json& r : c.at("runs")) cell.runs.push_back(read_run(r));
    }
  } catch (const nlohmann::json::exception& e) {
    throw Error(
        ErrorCode::data, file.string(),
        fmt::format("expected the results.json of a matrix, found other JSON: {}", e.what()));
  }
  return out;
}

}  // namespace cambium::matrix
