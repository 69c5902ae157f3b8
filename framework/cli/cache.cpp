// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <charconv>

#include "engine/cache_upkeep.hpp"
#include "host.hpp"

namespace cambium::cli {
namespace {

struct Options {
  std::string folder, larger_than, unused_for;
  std::filesystem::path path() const {
    return folder.empty() ? default_cache_folder() : std::filesystem::path(folder);
  }
};

std::string shown(std::uintmax_t bytes) {
  const char* units[] = {"B", "KB", "MB", "GB", "TB"};
  double value = double(bytes);
  int unit = 0;
  for (; value >= 1000 && unit < 4; ++unit) value /= 1024;
  return fmt::format("{:.{}f} {}", value, unit == 0 ? 0 : 1, units[unit]);
}

std::string shown(std::chrono::seconds age) {
  const auto hours = std::chrono::duration_cast<std::chrono::hours>(age).count();
  if (hours == 0) return "< 1 h";
  return hours < 48 ? fmt::format("{} h", hours) : fmt::format("{} days", hours / 24);
}

// "12h", "30d", "4w"
std::chrono::seconds parse_age(const std::string& text) {
  const std::string units = "hdw";
  const int hours[] = {1, 24, 168};
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const std::string unit(end, text.data() + text.size());
  if (error != std::errc{} || !(value >= 0) || unit.size() != 1 ||
      units.find(unit) == std::string::npos)
    throw Error(ErrorCode::config, "--unused-for",
                fmt::format("expected an age such as 12h, 30d or 4w, found '{}'", text));
  return std::chrono::seconds(std::int64_t(value * 3600 * hours[units.find(unit)]));
}

void list(const Options& o) {
  CacheGroup all;
  fmt::print("{:<36} {:>8} {:>10} {:>10} {:>9} {:>9}\n", "made by", "entries", "size", "seconds",
             "used", "unused");
  for (const auto& [kind, g] : cache_by_kind(o.path())) {
    fmt::print("{:<36} {:>8} {:>10} {:>10.1f} {:>9} {:>9}\n", kind, g.entries, shown(g.bytes),
               g.seconds, shown(g.newest), shown(g.oldest));
    all.entries += g.entries, all.bytes += g.bytes, all.seconds += g.seconds;
  }
  fmt::print("{:<36} {:>8} {:>10} {:>10.1f}   in {}\n", "all", all.entries, shown(all.bytes),
             all.seconds, o.path().string());
}

void prune(const Options& o) {
  PruneLimits limits;
  if (!o.larger_than.empty()) limits.bytes = parse_bytes(o.larger_than, "--larger-than");
  if (!o.unused_for.empty()) limits.unused = parse_age(o.unused_for);
  if (!limits.bytes && !limits.unused)
    throw Error(ErrorCode::config, "cache prune",
                "expected --larger-than SIZE, --unused-for AGE or both");
  const Pruned p = prune_cache(o.path(), limits);
  fmt::print("{} entries removed ({}), {} kept ({})\n", p.removed, shown(p.removed_bytes), p.kept,
             shown(p.kept_bytes));
}

void verify(const Options& o) {
  const auto damaged = remove_damaged(o.path());
  for (const auto& file : damaged) fmt::print("removed {}\n", file.string());
  fmt::print("{} damaged entries{}\n", damaged.size(),
             damaged.empty() ? "" : "; the next run computes them again");
}

CLI::App* add(CLI::App& cache, Options& o, const char* name, const char* help) {
  CLI::App* sub = cache.add_subcommand(name, help);
  sub->add_option("--cache", o.folder, "Cache folder (default: as in 'cambium run')");
  return sub;
}

}  // namespace

void add_cache(CLI::App& app) {
  auto o = std::make_shared<Options>();
  CLI::App* cache = app.add_subcommand("cache", "Look after the results that later runs take up");
  cache->require_subcommand(1);
  cache->footer(
      "All of it is safe while runs use the folder.\n"
      "Example: cambium cache prune --larger-than 20G --unused-for 30d");
  add(*cache, *o, "list", "What made the entries, their sizes, and since when they are unused")
      ->callback([o] { list(*o); });
  add(*cache, *o, "verify", "Read every entry; remove those that do not fit their digest")
      ->callback([o] { verify(*o); });
  CLI::App* p = add(*cache, *o, "prune", "Remove the entries that were unused for longest");
  p->add_option("--larger-than", o->larger_than, "Until all together are no larger, e.g. 20G");
  p->add_option("--unused-for", o->unused_for, "Those unused for longer, e.g. 12h, 30d, 4w");
  p->callback([o] { prune(*o); });
}

}  // namespace cambium::cli
