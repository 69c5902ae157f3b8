// SPDX-License-Identifier: BSD-3-Clause
// `cambium plugins bench`: what a component costs, beside the others of its kind.
#include <fmt/format.h>

#include <algorithm>

#include <nlohmann/json.hpp>

#include "conformance/bench.hpp"
#include "engine/missions.hpp"
#include "host.hpp"
#include "pipeline/diagnostics.hpp"
#include "pipeline/preset.hpp"

namespace cambium::cli {
namespace {

using conformance::Measured;
using conformance::World;

struct Options {
  std::string name, kind;
  std::vector<std::string> settings, data;
  double seconds = 1;
  bool json = false, alone = false;
  std::shared_ptr<PluginOptions> plugins;
};

/// The component that is asked for, with its parameters. A name may be one of several kinds.
Registered subject_of(const Registry& registry, const Options& o) {
  std::vector<std::string> names, kinds;
  std::optional<Registered> found;
  for (const auto& [key, component] : registry.all()) {
    names.push_back(component.name);
    if (component.name != o.name) continue;
    kinds.emplace_back(to_string(component.kind));
    if (o.kind.empty() || o.kind == kinds.back()) found = component;
  }
  if (kinds.empty())
    throw Error(ErrorCode::config, "NAME",
                fmt::format("no plugin is called '{}'{}", o.name, suggestion(o.name, names)));
  if (!found || (o.kind.empty() && kinds.size() > 1))
    throw Error(
        ErrorCode::config, "--kind",
        fmt::format("'{}' is of {} kind(s){}", o.name, kinds.size(), suggestion(o.kind, kinds)));
  return preset(*found, o.settings);
}

/// First the subject, then the others of its kind that run with their defaults.
std::vector<Registered> contestants(const Registry& registry, const Options& o) {
  std::vector<Registered> out = {subject_of(registry, o)};
  out[0].create();  // what is wrong with its parameters comes out here
  for (const auto& [key, component] : registry.all())
    if (!o.alone && component.kind == out[0].kind && component.name != o.name &&
        component.create()->check_params().empty())
      out.push_back(component);
  return out;
}

World recorded(const Options& o, const Registry& registry, const Engine& engine) {
  if (o.data.size() != 2)
    throw Error(ErrorCode::config, "--data",
                fmt::format("expected two missions, --data A --data B, found {}", o.data.size()));
  Pipeline pipeline;
  pipeline.file = "--data";
  for (const std::string& path : o.data)
    pipeline.missions.push_back(
        {std::filesystem::absolute(path).string(), "", "", {}, "--data " + path});
  return conformance::world_of(read_missions(pipeline, registry, engine));
}

std::string percent(const std::optional<double>& share) {
  return share ? fmt::format("{:.0f}", 100 * *share) : "";
}

void print_table(const std::vector<Measured>& rows, Kind kind) {
  fmt::print("One use of a {} {}; the median, on one thread.\n\n", to_string(kind),
             conformance::use_of(kind));
  const bool places = kind == Kind::place_recognizer;
  fmt::print("| {} | points a cloud | uses | one use [ms] | memory on top [MB] |{}\n",
             to_string(kind), places ? " recall at 1 [%] | precision [%] |" : "");
  fmt::print("|---|---|---|---|---|{}\n", places ? "---|---|" : "");
  for (const Measured& m : rows) {
    fmt::print("| {} | {:.0f} | ", m.component, m.points);
    if (m.refusal.empty())
      fmt::print("{} | {:.3g} | {:.1f} |", m.uses, m.milliseconds, m.megabytes);
    else
      fmt::print("0 | {} | |", m.refusal);
    fmt::print("{}\n",
               places ? fmt::format(" {} | {} |", percent(m.recall), percent(m.precision)) : "");
  }
}

void print_json(const std::vector<Measured>& rows, Kind kind) {
  nlohmann::ordered_json out = {{"kind", to_string(kind)},
                                {"use", conformance::use_of(kind)},
                                {"rows", nlohmann::json::array()}};
  for (const Measured& m : rows) {
    nlohmann::ordered_json row = {{"name", m.component}, {"points", m.points}};
    if (m.refusal.empty())
      row.update({{"uses", m.uses}, {"milliseconds", m.milliseconds}, {"megabytes", m.megabytes}});
    else
      row["refusal"] = m.refusal;
    if (m.recall) row["recall"] = *m.recall;
    if (m.precision) row["precision"] = *m.precision;
    out["rows"].push_back(row);
  }
  fmt::print("{}\n", out.dump(1));
}

void run(const Options& o) {
  const PluginLoader loader = o.plugins->load();
  const auto all = contestants(loader.registry(), o);
  Progress progress(Progress::Style::quiet, LogLevel::error);
  const Engine engine({1, std::size_t(1) << 30, std::nullopt, nullptr}, progress);
  const World full =
      o.data.empty() ? conformance::make_world() : recorded(o, loader.registry(), engine);
  std::vector<Measured> rows;
  for (const Registered& component : all)
    for (const std::size_t step : {16, 4, 1})
      rows.push_back(conformance::measure(component, loader.registry(),
                                          conformance::thinned(full, step), o.seconds));
  o.json ? print_json(rows, all[0].kind) : print_table(rows, all[0].kind);
  if (!rows[0].refusal.empty()) throw Error(ErrorCode::check, o.name, rows[0].refusal);
}

}  // namespace

void add_plugins_bench(CLI::App& plugins, const std::shared_ptr<PluginOptions>& options) {
  auto o = std::make_shared<Options>();
  o->plugins = options;
  CLI::App* sub = plugins.add_subcommand("bench", "Time and memory beside the others of its kind");
  sub->fallthrough();
  sub->add_option("NAME", o->name, "As in a pipeline")->required();
  sub->add_option("--kind", o->kind, "Which, when components of several kinds have the name");
  sub->add_option("--set", o->settings, "A parameter: PARAM=VALUE; may be given several times")
      ->allow_extra_args(false);
  sub->add_option("--data", o->data,
                  "A mission; twice (default: the small simulated forest of 'plugins check'). With "
                  "ground_truth.tum recall and precision are true, else as good as the odometry")
      ->allow_extra_args(false);
  sub->add_option("--seconds", o->seconds, "At least so long for each row")
      ->check(CLI::Range(0.0, 3600.0))
      ->capture_default_str();
  sub->add_flag("--alone", o->alone, "Without the others of its kind");
  sub->add_flag("--json", o->json, "The table as JSON");
  sub->footer(
      "Clouds come with every 16th, every 4th, and every point.\n"
      "Example: cambium plugins bench scan_context --data mission_a --data mission_b");
  sub->callback([o] { run(*o); });
}

}  // namespace cambium::cli
