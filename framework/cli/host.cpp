// SPDX-License-Identifier: BSD-3-Clause
#include "host.hpp"

#include <fmt/format.h>

#include <charconv>
#include <csignal>

#include "plugins/search_path.hpp"

namespace cambium::cli {
namespace {

std::atomic<bool> cancelled{false};
static_assert(std::atomic<bool>::is_always_lock_free, "used in a signal handler");

// The first signal asks for an orderly end; the next one has the default effect.
void on_signal(int signal) {
  cancelled = true;
  std::signal(signal, SIG_DFL);
}

}  // namespace

void PluginOptions::add_to(CLI::App& app) {
  app.add_option("--plugin-path", path,
                 "Folder or library with plugins, besides CAMBIUM_PLUGIN_PATH and the installed "
                 "ones; may be given several times")
      ->type_name("PATH");
}

PluginLoader PluginOptions::load() const {
  PluginLoader loader;
  loader.load(plugin_search_path(path));
  for (const Error& e : loader.refusals()) fmt::print(stderr, "warning: {}\n", e.what());
  return loader;
}

void EngineFlags::add_to(CLI::App& app) {
  app.add_option("--threads", threads, "Threads to use; 0 = all cores")
      ->check(CLI::Range(0, 4096))
      ->capture_default_str();
  app.add_option("--memory", memory,
                 "Memory to stay within, such as 500M or 4G: beyond it payloads are not kept for "
                 "later and work items run one at a time")
      ->capture_default_str();
  app.add_option("--cache", cache,
                 "Folder for results that later runs take up, or 'none' (default: CAMBIUM_CACHE, "
                 "else the user's cache folder)");
  app.add_flag("--log-json", json, "Progress and messages as JSON lines on stderr");
  app.add_flag("--quiet", quiet, "Warnings and errors only");
  app.add_flag("--verbose", verbose, "Debug messages too");
}

Progress EngineFlags::progress() const {
  const auto style = json    ? Progress::Style::json
                     : quiet ? Progress::Style::quiet
                             : Progress::Style::automatic;
  return Progress(style, verbose ? LogLevel::debug : LogLevel::info);
}

EngineOptions EngineFlags::options() const {
  std::signal(SIGINT, &on_signal);
  std::signal(SIGTERM, &on_signal);
  EngineOptions o;
  o.threads = threads;
  o.memory = parse_bytes(memory, "--memory");
  if (cache.empty())
    o.cache = default_cache_folder();
  else if (cache != "none")
    o.cache = cache;
  o.cancelled = &cancelled;
  return o;
}

std::size_t parse_bytes(const std::string& text, const char* option) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const std::string unit(end, text.data() + text.size());
  const std::string units = "KMGT";
  const auto power = unit.empty() ? 0 : int(units.find(char(std::toupper(unit[0])))) + 1;
  if (error != std::errc{} || !(value > 0) || unit.size() > 1 || (power == 0 && !unit.empty()))
    throw Error(ErrorCode::config, option,
                fmt::format("expected a size such as 500M or 4G, found '{}'", text));
  return std::size_t(value * std::pow(1024.0, power));
}

std::pair<std::size_t, std::size_t> parse_shard(const std::string& text) {
  std::size_t index = 0, count = 0;
  const char* const end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, index);
  const bool slash = first.ec == std::errc{} && first.ptr != end && *first.ptr == '/';
  if (!slash || std::from_chars(first.ptr + 1, end, count).ptr != end || index < 1 || index > count)
    throw Error(ErrorCode::config, "--shard",
                fmt::format("expected I/N with 1 <= I <= N, found '{}'", text));
  return {index, count};
}

}  // namespace cambium::cli
