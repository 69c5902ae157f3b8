// SPDX-License-Identifier: BSD-3-Clause
// What the commands share: plugins, threads, cache, log style, Ctrl-C.
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "engine/engine.hpp"
#include "plugins/loader.hpp"

namespace cambium::cli {

/// Options of every command that opens plugins.
struct PluginOptions {
  std::vector<std::string> path;
  void add_to(CLI::App& app);
  /// Refused libraries become warnings on stderr.
  PluginLoader load() const;
};

/// Options of every command that runs steps.
struct EngineFlags {
  int threads = 0;
  std::string memory = "4G";
  std::string cache;
  bool json = false, quiet = false, verbose = false;
  void add_to(CLI::App& app);
  Progress progress() const;
  EngineOptions options() const;  ///< installs the Ctrl-C handler
};

/// "4G", "500M", "1.5G", plain bytes. Throws Error(config) naming `option`.
std::size_t parse_bytes(const std::string& text, const char* option);

/// "2/5" -> {2, 5}. Throws Error(config) unless 1 <= I <= N.
std::pair<std::size_t, std::size_t> parse_shard(const std::string& text);

/// Every command adds itself; its callback runs it. Errors leave as cambium::Error.
void add_run(CLI::App& app);
void add_validate(CLI::App& app);
void add_plugins(CLI::App& app);
void add_schema(CLI::App& app);
void add_inspect(CLI::App& app);
void add_import(CLI::App& app);
void add_evaluate(CLI::App& app);
void add_simulate(CLI::App& app);
void add_cache(CLI::App& app);
void add_matrix(CLI::App& app);
void add_batch(CLI::App& app);
void add_compare(CLI::App& app);
void add_plan(CLI::App& app);
void add_merge(CLI::App& app);
void add_split(CLI::App& app);
void add_poses(CLI::App& app);
void add_report(CLI::App& app);
void add_query(CLI::App& app);
void add_changes(CLI::App& app);
void add_view(CLI::App& app);

}  // namespace cambium::cli
