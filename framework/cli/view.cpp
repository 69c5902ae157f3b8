// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>

#include "cambium/files.hpp"
#include "engine/export_run.hpp"
#include "host.hpp"
#include "serve/site.hpp"

namespace cambium::cli {
namespace {

namespace fs = std::filesystem;

struct Options {
  fs::path run;
  std::string exporter;
  fs::path changes;
  int port = 8765;
  bool again = false;
  PluginOptions plugins;
  EngineFlags engine;
};

/// The page of the folder itself, or else of its export `name` (any when empty); empty: none.
fs::path page_in(const fs::path& folder, const std::string& name) {
  if (!fs::is_directory(folder))
    throw Error(ErrorCode::config, folder.string(), "is no folder");
  const auto has_page = [](const fs::path& f) { return fs::is_regular_file(f / "index.html"); };
  if (has_page(folder)) return folder;
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(folder))
    if (has_page(entry.path()) && (name.empty() || entry.path().filename() == name))
      found.push_back(entry.path());
  std::sort(found.begin(), found.end());
  if (found.size() > 1) {
    std::string all;
    for (const fs::path& page : found) all += ' ' + page.string();
    throw Error(ErrorCode::config, folder.string(),
                "holds several pages; name the folder of one:" + all);
  }
  return found.empty() ? fs::path() : found.front();
}

/// Puts the layer of a comparison on a page that takes layers; they stay until the page is written
/// anew.
void add_layer(const fs::path& comparison, const fs::path& page) {
  const fs::path layers = page / "layers.json";
  if (!fs::is_regular_file(layers))
    throw Error(ErrorCode::config, page.string(),
                "is a page that takes no layers (it has no layers.json); write it anew: --again");
  if (!fs::is_regular_file(comparison / "layer.json"))
    throw Error(ErrorCode::config, comparison.string(),
                "holds no layer.json; expected what 'cambium changes --out' wrote");
  std::string layer = read_file(comparison / "layer.json");
  while (!layer.empty() && layer.back() == '\n') layer.pop_back();
  write_file(layers, "[" + layer + "]\n");
}

void run(const Options& o) {
  const EngineOptions engine_options = o.engine.options();
  fs::path page = o.again ? fs::path() : page_in(o.run, o.exporter);
  if (page.empty()) {
    const PluginLoader loader = o.plugins.load();
    Progress progress = o.engine.progress();
    const Engine engine(engine_options, progress);
    export_run(o.run, page_exporter(o.exporter, loader.registry()), loader.registry(), engine);
    page = page_in(o.run, o.exporter);
  }
  if (!o.changes.empty()) add_layer(o.changes, page);
  serve::Site site(page, o.port);
  fmt::print("{} at http://127.0.0.1:{}/ (Ctrl-C stops)\n", page.string(), site.port());
  std::fflush(stdout);
  site.run([&] { return engine_options.cancelled->load(); });
}

}  // namespace

void add_view(CLI::App& app) {
  auto o = std::make_shared<Options>();
  CLI::App* sub = app.add_subcommand("view", "Look at a finished run in a browser");
  sub->add_option("RUN", o->run, "Run folder, or a folder with an index.html")->required();
  sub->add_option("--port", o->port, "Port on 127.0.0.1; 0 takes any free one")
      ->check(CLI::Range(0, 65535))
      ->capture_default_str();
  sub->add_option("--exporter", o->exporter,
                  "Exporter that makes the page, when several plugins can (default: the only one)");
  sub->add_option("--changes", o->changes,
                  "Also show what 'cambium changes' found: the folder that it wrote");
  sub->add_flag("--again", o->again, "Write the page anew, even when there is one");
  o->plugins.add_to(*sub);
  o->engine.add_to(*sub);
  sub->footer(
      "Serves to this machine only. A run without a page gets one first, which is then part of it.\n"
      "Example: cambium view fused");
  sub->callback([o] { run(*o); });
}

}  // namespace cambium::cli
