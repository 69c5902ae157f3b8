// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <cmath>
#include <iterator>

#include "cambium/statistics.hpp"
#include "monitor/changes_output.hpp"

namespace cambium::monitor {
namespace {

std::size_t count(const Changes& changes, Change what) {
  std::size_t out = 0;
  for (const StemChange& c : changes.stems) out += c.change == what;
  return out;
}

/// Of the trees that both surveys measured. The standard error is that of the scatter between
/// trees, so it holds whatever the single sigmas are worth.
Json growth_json(const Changes& changes) {
  std::vector<double> growth;
  for (const StemChange& c : changes.stems)
    if (c.change == Change::kept && std::isfinite(c.growth)) growth.push_back(c.growth);
  double mean = 0, sum = 0;
  for (const double g : growth) mean += g / double(growth.size());
  for (const double g : growth) sum += (g - mean) * (g - mean);
  const double sd = std::sqrt(sum / double(growth.size() - 1));
  Json out;
  out["trees"] = growth.size();
  out["mean"] = growth.empty() ? Json() : rounded(mean, 4);
  out["sigma"] = growth.size() < 2 ? Json() : rounded(sd / std::sqrt(double(growth.size())), 4);
  out["median"] = rounded(median(growth), 4);
  return out;
}

Json heights_json(const Changes& changes, std::optional<double> CellChange::*height) {
  std::vector<double> values;
  for (const CellChange& c : changes.cells)
    if (c.*height) values.push_back(*(c.*height));
  Json out;
  out["cells"] = values.size();
  out["median"] = rounded(median(values), 3);
  for (double& v : values) v = std::abs(v);
  out["median_absolute"] = rounded(median(values), 3);
  return out;
}

}  // namespace

Json summary_json(const Survey& before, const Survey& after, const Changes& c) {
  Json out;
  out["before"] = before.name;
  out["after"] = after.name;
  out["stems"] = {{"kept", count(c, Change::kept)},
                  {"gone", count(c, Change::gone)},
                  {"new", count(c, Change::appeared)},
                  {"overlooked", count(c, Change::overlooked)},
                  {"unsure", count(c, Change::unsure)}};
  out["growth"] = growth_json(c);
  out["ground"] = heights_json(c, &CellChange::ground);
  out["canopy"] = heights_json(c, &CellChange::canopy);
  out["alignment"] = {{"trees", c.aligned_by},
                      {"rms", c.aligned_by ? rounded(c.aligned_rms, 3) : Json()},
                      {"yaw", rounded(c.T_before_after.yaw(), 5)},
                      {"translation",
                       {rounded(c.T_before_after.t.x(), 3), rounded(c.T_before_after.t.y(), 3),
                        rounded(c.T_before_after.t.z(), 3)}}};
  return out;
}

std::string summary_text(const Json& s) {
  std::string out;
  const auto line = std::back_inserter(out);
  const auto number = [](const Json& v, const char* unit) {
    return v.is_null() ? std::string("-") : fmt::format("{} {}", v.dump(), unit);
  };
  fmt::format_to(line, "{} -> {}\n", s["before"].get<std::string>(), s["after"].get<std::string>());
  const Json& stems = s["stems"];
  fmt::format_to(line, "trees    {} kept, {} gone, {} new, {} overlooked before, {} unsure\n",
                 stems["kept"].dump(), stems["gone"].dump(), stems["new"].dump(),
                 stems["overlooked"].dump(), stems["unsure"].dump());
  fmt::format_to(line, "growth   {} +- {} of the diameter, {} trees\n",
                 number(s["growth"]["mean"], "m"), number(s["growth"]["sigma"], "m"),
                 s["growth"]["trees"].dump());
  for (const char* what : {"ground", "canopy"})
    fmt::format_to(line, "{:<8} {} (median), {} (median of the size), {} cells\n", what,
                   number(s[what]["median"], "m"), number(s[what]["median_absolute"], "m"),
                   s[what]["cells"].dump());
  if (s["alignment"]["trees"].get<std::size_t>() > 0)
    fmt::format_to(line, "aligned  by {} trees, which lie {} apart (rms)\n",
                   s["alignment"]["trees"].dump(), number(s["alignment"]["rms"], "m"));
  return out;
}

}  // namespace cambium::monitor
