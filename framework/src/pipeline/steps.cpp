// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/steps.hpp"

#include <fmt/format.h>

#include "pipeline/binder.hpp"

namespace cambium {
namespace {

void parse_platform(int id, const Yaml& word, const Yaml& body, Pipeline& p,
                    Diagnostics& diagnostics) {
  const Verb* verb = find_verb(word.scalar);
  if (!verb || !verb->per_platform) {
    std::vector<std::string> allowed;
    for (const auto& v : verbs())
      if (v.per_platform) allowed.push_back(v.word);
    diagnostics.add(word.where, fmt::format("'{}' cannot differ between platforms{}", word.scalar,
                                            suggestion(word.scalar, allowed)));
    return;
  }
  check_keys(body, {"params"}, "a platform's step", diagnostics);
  const Yaml* params = body.find("params");
  bool used = false;
  for (auto& step : p.steps)
    if (step.verb == verb && params) {
      step.platform_params[id] = *params;
      used = true;
    }
  if (!used)
    diagnostics.add(word.where,
                    fmt::format("no step '{}' with params to override here", word.scalar));
}

}  // namespace

std::optional<StepSpec> parse_step(const Yaml& s, Diagnostics& diagnostics) {
  StepSpec step;
  step.where = s.where;
  Yaml keys;
  keys.type = Yaml::Type::map;
  keys.where = s.where;
  for (const auto& item : s.map) {
    if (const Verb* verb = find_verb(item.key.scalar)) {
      if (step.verb)
        diagnostics.add(item.key.where, fmt::format("a second verb '{}' in one step, after '{}'",
                                                    verb->word, step.verb->word));
      step.verb = verb;
      step.plugin = item.value.scalar;
      step.plugin_where = item.value.where;
      if (!item.value.is_scalar())
        diagnostics.add(item.value.where, fmt::format("'{}' must name a plugin, found {}",
                                                      verb->word, item.value.shown()));
    } else if (item.key.scalar == "params") {
      step.params = item.value;
    } else {
      keys.map.push_back(item);
    }
  }
  if (!step.verb) {
    const std::string word = s.map.empty() ? s.scalar : s.map.front().key.scalar;
    diagnostics.add(s.where,
                    "a step must open with a verb and a plugin such as 'optimize: "
                    "ceres', found '" +
                        word + "'" + suggestion(word, verb_words()));
    return std::nullopt;
  }
  step.keys = StepKeys(step.verb);
  bind_params(step.keys, keys, diagnostics);
  return step;
}

void parse_platforms(const Yaml& platforms, Pipeline& p, Diagnostics& diagnostics) {
  for (const auto& [id, verbs_of] : platforms.map) {
    const auto number = id.as_int();
    if (!number) {
      diagnostics.add(id.where,
                      "a platform must be a PLATFORM_ID (a whole number), found " + id.shown());
      continue;
    }
    for (const auto& [word, body] : verbs_of.map)
      parse_platform(int(*number), word, body, p, diagnostics);
  }
}

}  // namespace cambium
