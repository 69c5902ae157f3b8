// SPDX-License-Identifier: BSD-3-Clause
#include "matrix/study.hpp"

#include <algorithm>

#include "cambium/files.hpp"
#include "engine/output_folder.hpp"
#include "matrix/table.hpp"

namespace cambium::matrix {
namespace {

namespace fs = std::filesystem;

void open_folder(const fs::path& out, const Spec& spec) {
  open_output_folder(out, "study.yaml", "a matrix or batch");
  write_file(out / "study.yaml", read_file(spec.file));
}

// The columns that the file asks for, in its order; all metrics when it asks for none.
std::vector<std::string> columns(const Spec& spec, const std::vector<CellResult>& cells) {
  const auto names = metric_names(cells);
  if (spec.metrics.empty()) return names;
  std::vector<std::string> out;
  for (const std::string& pattern : spec.metrics)
    for (const std::string& name : names)
      if (fits(pattern, name) && std::find(out.begin(), out.end(), name) == out.end())
        out.push_back(name);
  return out;
}

}  // namespace

Results run_study(const Spec& spec, const Registry& registry, const RunSettings& settings,
                  const Engine& engine, bool update_baseline) {
  const fs::path baseline_file = spec.beside(spec.baseline);
  Baseline baseline;
  const bool has_baseline = !spec.baseline.empty();
  if (has_baseline && (!update_baseline || fs::exists(baseline_file)))
    baseline = read_baseline(baseline_file);
  const auto cells = make_cells(spec, registry);
  open_folder(settings.out, spec);
  Results results;
  results.title = spec.file.filename().string();
  results.cells = run_cells(spec, cells, settings, engine);
  results.metrics = columns(spec, results.cells);
  results.findings =
      judge(spec, results.cells, has_baseline && !update_baseline ? &baseline : nullptr);
  if (update_baseline) write_file(baseline_file, format_baseline(spec, results.cells, baseline));
  write_file(settings.out / "results.json", to_json(results).dump(1) + "\n");
  write_file(settings.out / "results.md", markdown(results));
  write_file(settings.out / "junit.xml", junit_xml(results));
  write_file(settings.out / "index.html", html(results));
  return results;
}

// Neighbours begin alike, so a part is a block of them: it shares most within itself.
std::vector<CellResult> run_study_shard(const Spec& spec, const Registry& registry,
                                        const RunSettings& settings, const Engine& engine,
                                        std::size_t index, std::size_t count) {
  const auto all = make_cells(spec, registry);
  const auto begin = all.begin() + std::ptrdiff_t(all.size() * (index - 1) / count);
  const auto end = all.begin() + std::ptrdiff_t(all.size() * index / count);
  open_folder(settings.out, spec);
  return run_cells(spec, {begin, end}, settings, engine);
}

}  // namespace cambium::matrix
