// SPDX-License-Identifier: BSD-3-Clause
#include "engine/explain.hpp"

#include <fmt/format.h>

#include "cambium/files.hpp"

namespace cambium {
namespace {

// "rings: 20 -> 30" for parameters, the bare part's name for digests.
std::string difference(const std::string& part, const std::string& before,
                       const std::string& after) {
  if (!part.starts_with("params") && part != "step") return part;
  const Json a = Json::parse(before, nullptr, false), b = Json::parse(after, nullptr, false);
  std::string text;
  for (const auto& [name, value] : b.items()) {
    const Json old = a.contains(name) ? a[name] : Json(nullptr);
    if (old != value)
      text +=
          fmt::format("{}{}: {} -> {}", text.empty() ? "" : ", ", name, old.dump(), value.dump());
  }
  if (text.empty() || part == "params" || part == "step") return text.empty() ? part : text;
  return part + ": " + text;
}

}  // namespace

Explainer::Explainer(const std::filesystem::path& previous) {
  if (std::filesystem::exists(previous))
    previous_ = Json::parse(read_file(previous), nullptr, false);
}

std::string Explainer::explain(std::size_t index, const StepRecord& step) const {
  const std::string title = fmt::format("  why: {} {}: ", step.verb, step.plugin);
  if (step.items > 0 && step.cached == step.items)
    return title + "nothing changed, taken from the cache";
  if (!previous_.is_object() || !previous_.contains("steps"))
    return title + "no earlier run was finished in this folder";
  const Json& steps = previous_["steps"];
  if (index >= steps.size() || steps[index]["verb"] != step.verb ||
      steps[index]["plugin"] != step.plugin)
    return title + "the earlier run had another step here";
  std::string changed;
  for (const auto& [part, value] : step.key) {
    const std::string before = steps[index]["key"].value(part, "");
    if (part == "files" && !changed.empty()) continue;  // it also has the parts before it
    if (before != value) changed += (changed.empty() ? "" : "; ") + difference(part, before, value);
  }
  if (changed.empty()) changed = "nothing changed, but the cache did not hold the result";
  return title + fmt::format("changed: {} ({} of {} items from the cache)", changed, step.cached,
                             step.items);
}

}  // namespace cambium
