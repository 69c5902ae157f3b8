// SPDX-License-Identifier: BSD-3-Clause
// `cambium plugins check`: the conformance kit, one process a component.
#include <fmt/format.h>

#include <algorithm>

#include "cambium/files.hpp"
#include "conformance/judge.hpp"
#include "conformance/law.hpp"
#include "engine/child.hpp"
#include "engine/program.hpp"
#include "host.hpp"
#include "pipeline/diagnostics.hpp"
#include "pipeline/preset.hpp"
#include "plugins/search_path.hpp"

namespace cambium::cli {
namespace {

namespace fs = std::filesystem;
using conformance::Finding;
using conformance::Outcome;

struct Options {
  std::vector<std::string> libraries, settings;
  std::string only, component, record;
  double time_limit = 300;
  bool all = false;
  std::shared_ptr<PluginOptions> plugins;
};

std::string title(const Registered& r) { return fmt::format("{} {}", to_string(r.kind), r.name); }

std::string ending_of(const Child::Outcome& o, double limit) {
  if (o.timed_out) return fmt::format("was stopped after {:.0f} s", limit);
  if (o.signal != 0) return fmt::format("ended by signal {}", o.signal);
  return o.exit_code == 0 ? "" : fmt::format("ended with exit code {}", o.exit_code);
}

std::vector<Finding> judge_apart(const Registered& r, const Options& o, const fs::path& folder) {
  const fs::path record = folder / "record", log = folder / "log";
  std::vector<std::string> command = {
      program_path().string(), "plugins", "check",    r.library,
      "--component",           title(r),  "--record", record.string()};
  for (const std::string& entry : o.plugins->path)
    command.insert(command.end(), {"--plugin-path", entry});
  for (const std::string& setting : o.settings) command.insert(command.end(), {"--set", setting});
  write_file(record, "");
  Child child(std::move(command), log, o.time_limit);
  while (!child.ended()) wait_any({child.descriptor()}, 0.2);
  return conformance::read_record(title(r), read_file(record),
                                  ending_of(child.outcome(), o.time_limit), read_file(log));
}

void judge_one(const Options& o, const Registry& own, const Registry& all) {
  for (const auto& [key, registered] : own.all())
    if (title(registered) == o.component)
      return conformance::judge_here(preset(registered, o.settings), all, o.record);
  throw Error(ErrorCode::plugin, o.libraries[0], fmt::format("has no '{}'", o.component));
}

std::size_t print(const std::vector<Finding>& findings, bool all) {
  std::size_t broken = 0;
  for (const Finding& f : findings) {
    broken += f.outcome == Outcome::broken;
    if (f.outcome == Outcome::holds && !all) continue;
    const char* mark = f.outcome == Outcome::holds    ? "ok     "
                       : f.outcome == Outcome::broken ? "BROKEN "
                                                      : "skipped";
    fmt::print("  {}  {}{}{}\n", mark, f.law, f.detail.empty() ? "" : ": ", f.detail);
  }
  return broken;
}

/// "python", "place_recognizer" or "place_recognizer python".
bool chosen(const Registered& r, const std::string& only) {
  return only.empty() || only == r.name || only == to_string(r.kind) || only == title(r);
}

/// What stands on the command line is a library, or the name of a component that is found.
fs::path library_of(const std::string& text, const Options& o) {
  if (fs::exists(text)) return text;
  PluginLoader loader;
  loader.load(plugin_search_path(o.plugins->path));
  std::vector<std::string> names;
  for (const auto& [key, registered] : loader.registry().all()) {
    if (registered.name == text) return registered.library;
    names.push_back(registered.name);
  }
  throw Error(ErrorCode::config, text,
              "is neither a library nor the name of a plugin" + suggestion(text, names));
}

/// `name`: of the components to check; empty: all.
std::size_t check(const fs::path& library, const std::string& name, const Options& o,
                  const fs::path& folder) {
  const auto of_file = conformance::judge_library(library);
  fmt::print("{}\n", library.string());
  std::size_t broken = print(of_file, o.all);
  if (of_file.front().outcome == Outcome::broken) return broken;
  PluginLoader own;
  own.load_file(library);
  for (const auto& [key, registered] : own.registry().all()) {
    if (!chosen(registered, o.only) || !chosen(registered, name)) continue;
    const auto findings = judge_apart(registered, o, folder);
    const auto bad = std::count_if(findings.begin(), findings.end(),
                                   [](const Finding& f) { return f.outcome == Outcome::broken; });
    fmt::print("{} {}: {} laws, {} broken\n", to_string(registered.kind), registered.name,
               findings.size(), bad);
    broken += print(findings, o.all);
  }
  return broken;
}

void run(const Options& o) {
  if (!o.component.empty()) {
    PluginLoader own, all;
    own.load_file(o.libraries[0]);
    all.load(plugin_search_path(o.plugins->path));  // without a word: what is printed counts
    return judge_one(o, own.registry(), all.registry());
  }
  const conformance::Host host(1);
  std::size_t broken = 0;
  for (const std::string& library : o.libraries)
    broken += check(library_of(library, o), fs::exists(library) ? "" : library, o,
                    host.context()->scratch());
  if (broken > 0) throw Error(ErrorCode::check, "", fmt::format("{} law(s) are broken", broken));
}

}  // namespace

void add_plugins_check(CLI::App& plugins, const std::shared_ptr<PluginOptions>& options) {
  auto o = std::make_shared<Options>();
  o->plugins = options;
  CLI::App* sub = plugins.add_subcommand("check", "Try a plugin against the laws of its kind");
  sub->fallthrough();
  sub->add_option("LIBRARY", o->libraries, "Plugins to check (.so), or names as in a pipeline")
      ->required();
  sub->add_option("--only", o->only, "Only the components of this name, or of this kind");
  sub->add_option("--set", o->settings, "A parameter: PARAM=VALUE; may be given several times")
      ->allow_extra_args(false);
  sub->add_option("--time-limit", o->time_limit, "Seconds for a component")->capture_default_str();
  sub->add_flag("--all", o->all, "Show the laws that hold, too");
  // How the command calls itself for one component.
  sub->add_option("--component", o->component)->group("");
  sub->add_option("--record", o->record)->group("");
  sub->footer(
      "Exit code 1 when a law is broken.\n"
      "Example: cambium plugins check build/ring_key.so --all\n"
      "         cambium plugins check python --only place_recognizer --set script=my_method.py");
  sub->callback([o] { run(*o); });
}

}  // namespace cambium::cli
