// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "host.hpp"
#include "pipeline/describe.hpp"
#include "pipeline/diagnostics.hpp"
#include "pipeline/preset.hpp"

namespace cambium::cli {
namespace {

void list(const Registry& registry) {
  std::size_t width = 0;
  for (const auto& [key, c] : registry.all()) width = std::max(width, c.name.size());
  std::string kind;
  for (const auto& [key, c] : registry.all()) {
    if (kind != to_string(c.kind)) {
      kind = to_string(c.kind);
      fmt::print("{}\n", kind);
    }
    fmt::print("  {:<{}}  {}  ({} {})\n", c.name, width, c.summary, c.plugin, c.plugin_version);
  }
  if (registry.all().empty())
    fmt::print(stderr,
               "no plugins found; name their folder with --plugin-path or "
               "CAMBIUM_PLUGIN_PATH\n");
}

void describe(const Registry& registry, const std::string& name,
              const std::vector<std::string>& settings) {
  std::string sections;
  std::optional<Error> refused;
  std::vector<std::string> names;
  for (const auto& [key, c] : registry.all()) {
    names.push_back(c.name);
    if (c.name != name) continue;
    try {
      sections += describe_markdown(preset(c, settings));
    } catch (const Error& e) {  // a script is of one kind, its name of several
      refused = e;
    }
  }
  if (sections.empty() && refused) throw Error(*refused);
  if (sections.empty())
    throw Error(ErrorCode::config, "",
                fmt::format("no plugin is called '{}'{}", name, suggestion(name, names)));
  fmt::print("{}", sections);
}

}  // namespace

void add_plugins_new(CLI::App& plugins);
void add_plugins_check(CLI::App& plugins, const std::shared_ptr<PluginOptions>& options);
void add_plugins_bench(CLI::App& plugins, const std::shared_ptr<PluginOptions>& options);

void add_plugins(CLI::App& app) {
  CLI::App* sub = app.add_subcommand("plugins", "What can be named in a pipeline");
  sub->require_subcommand(1);
  sub->footer("Example: cambium plugins describe scan_context");
  auto options = std::make_shared<PluginOptions>();
  options->add_to(*sub);
  sub->add_subcommand("list", "All plugins by kind")->fallthrough()->callback([options] {
    list(options->load().registry());
  });
  auto name = std::make_shared<std::string>();
  CLI::App* d =
      sub->add_subcommand("describe", "One plugin, or all, with the parameters, as Markdown");
  d->fallthrough()->add_option("NAME", *name, "As in a pipeline; all when it is missing");
  auto settings = std::make_shared<std::vector<std::string>>();
  d->add_option("--set", *settings, "With this parameter: PARAM=VALUE, such as a script")
      ->allow_extra_args(false);
  d->callback([options, name, settings] {
    const PluginLoader loader = options->load();
    if (name->empty())
      fmt::print("{}", reference_markdown(loader.registry()));
    else
      describe(loader.registry(), *name, *settings);
  });
  add_plugins_new(*sub);
  add_plugins_check(*sub, options);
  add_plugins_bench(*sub, options);
}

}  // namespace cambium::cli
