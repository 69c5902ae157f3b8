// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <cmath>

#include "cambium/files.hpp"
#include "matrix/judge.hpp"
#include "matrix/tolerance.hpp"

namespace cambium::matrix {

Baseline read_baseline(const std::filesystem::path& file) {
  if (!std::filesystem::exists(file))
    throw Error(ErrorCode::config, file.string(),
                "the baseline is not there; write it with --update-baseline");
  try {
    return Json::parse(read_file(file)).at("cells").get<Baseline>();
  } catch (const nlohmann::json::exception& e) {
    throw Error(ErrorCode::data, file.string(),
                fmt::format("expected a baseline {{\"cells\": {{CELL: {{METRIC: number}}}}}}: {}",
                            e.what()));
  }
}

std::string format_baseline(const Spec& spec, const std::vector<CellResult>& cells,
                            const Baseline& before) {
  Baseline baseline;
  for (const CellResult& cell : cells) {
    if (cell.status() == Status::absent && before.contains(cell.name))
      baseline[cell.name] = before.at(cell.name);
    if (cell.status() != Status::ok) continue;
    for (const std::string& name : metric_names({cell})) {
      const double value = median(cell.values(name));
      if (tolerance_for(spec, name) && std::isfinite(value)) baseline[cell.name][name] = value;
    }
  }
  return Json{{"cells", baseline}}.dump(1) + "\n";
}

}  // namespace cambium::matrix
