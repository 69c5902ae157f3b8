// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>

#include "host.hpp"
#include "matrix/schema.hpp"
#include "matrix/study.hpp"
#include "matrix/table.hpp"

namespace cambium::cli {
namespace {

struct Options {
  std::filesystem::path file, out;
  std::size_t jobs = 0;
  int repeat = 0;
  std::string shard;
  bool update_baseline = false, schema = false;
  PluginOptions plugins;
  EngineFlags engine;
};

// https://no-color.org
bool colour() { return isatty(STDOUT_FILENO) != 0 && std::getenv("NO_COLOR") == nullptr; }

// Leaves its results in the cache, where the matrix itself finds them.
void run_shard(const Options& o, const matrix::Spec& spec, const Registry& registry,
               const EngineOptions& options, const Engine& engine) {
  const auto [index, count] = parse_shard(o.shard);
  const auto cells = run_study_shard(spec, registry, {o.out, o.jobs, options, o.plugins.path},
                                     engine, index, count);
  const auto ok = std::count_if(cells.begin(), cells.end(),
                                [](const auto& c) { return c.status() == matrix::Status::ok; });
  fmt::print("shard {}: {} of {} cells ran\n", o.shard, ok, cells.size());
}

void run(const Options& o, matrix::Form form) {
  const PluginLoader loader = o.plugins.load();
  if (o.schema) return fmt::print("{}\n", matrix::matrix_schema(loader.registry()).dump(2));
  if (o.file.empty() || o.out.empty())
    throw Error(ErrorCode::config, "", "expected FILE and --out DIR, see --help");
  matrix::Spec spec = matrix::load_spec(o.file, form);
  if (o.repeat > 0) spec.repeat = o.repeat;
  if (o.update_baseline && spec.baseline.empty())
    throw Error(ErrorCode::config, o.file.string(),
                "--update-baseline needs 'baseline: FILE' to know where to write");
  Progress progress = o.engine.progress();
  const EngineOptions options = o.engine.options();
  const Engine engine(options, progress);
  if (!o.shard.empty()) return run_shard(o, spec, loader.registry(), options, engine);
  const auto results = run_study(spec, loader.registry(), {o.out, o.jobs, options, o.plugins.path},
                                 engine, o.update_baseline);
  fmt::print("{}\n{}\n{}\n", table_text(make_table(results), colour()),
             findings_text(results, colour()), verdict(results));
  progress.log(LogLevel::info, fmt::format("page: {}", (o.out / "index.html").string()));
  if (!results.passed()) throw Error(ErrorCode::check, o.file.string(), verdict(results));
}

CLI::App* add(CLI::App& app, const std::shared_ptr<Options>& o, const char* name,
              const char* help) {
  CLI::App* sub = app.add_subcommand(name, help);
  sub->add_option("FILE", o->file, "What to run (YAML), see docs/matrix.md");
  sub->add_option("--out,-o", o->out, "Folder for results; new, empty, or of an earlier run");
  sub->add_option("--jobs", o->jobs,
                  "Cells side by side; 0 = as many as there are threads, and 512M for each")
      ->capture_default_str();
  sub->add_option("--shard", o->shard,
                  "I/N: run only this part of the cells, into the cache; judge nothing");
  o->plugins.add_to(*sub);
  o->engine.add_to(*sub);
  return sub;
}

}  // namespace

void add_matrix(CLI::App& app) {
  auto o = std::make_shared<Options>();
  CLI::App* sub =
      add(app, o, "matrix", "Run combinations of plugins on datasets and judge what they give");
  sub->add_option("--repeat", o->repeat, "Runs of each cell, replaces that of the file")
      ->check(CLI::Range(1, 1000));
  sub->add_flag("--update-baseline", o->update_baseline,
                "Write the results as the baseline instead of comparing with it");
  sub->add_flag("--schema", o->schema, "Print the JSON Schema of a matrix instead");
  sub->footer(
      "Exit code 1 when a cell fails, misses an expectation or is worse than the baseline.\n"
      "Example: cambium matrix pipelines/matrix/small.yaml --out out/small");
  sub->callback([o] { run(*o, matrix::Form::matrix); });
}

void add_batch(CLI::App& app) {
  auto o = std::make_shared<Options>();
  CLI::App* sub = add(app, o, "batch", "Run one pipeline on many datasets, with one summary");
  sub->footer(
      "A dataset that fails does not stop the others; the exit code is then 1.\n"
      "Example: cambium batch all_missions.yaml --out out/all");
  sub->callback([o] { run(*o, matrix::Form::batch); });
}

}  // namespace cambium::cli
