// SPDX-License-Identifier: BSD-3-Clause
#include "matrix/axis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <regex>

namespace cambium::matrix {
namespace {

std::string text_of(const Yaml& map, const char* key, Diagnostics& diagnostics) {
  const Yaml* value = map.find(key);
  if (value && !value->is_scalar())
    diagnostics.add(value->where,
                    fmt::format("'{}' must be a text, found {}", key, value->shown()));
  return value ? value->scalar : "";
}

void add_choice(const Yaml& yaml, Axis& axis, Diagnostics& diagnostics) {
  Choice c{"", yaml.is_scalar() ? yaml.scalar : "", {}, yaml.where};
  if (yaml.is_map()) {
    check_keys(yaml, {"plugin", "name", "params"}, "a value of an axis", diagnostics);
    c.plugin = text_of(yaml, "plugin", diagnostics);
    c.name = text_of(yaml, "name", diagnostics);
    if (const Yaml* params = yaml.find("params")) c.params = *params;
  }
  if (c.plugin.empty())
    return diagnostics.add(
        yaml.where,
        "expected a plugin or {plugin: ..., name: ..., params: {...}}, found " + yaml.shown());
  if (c.name.empty()) c.name = c.plugin;
  check_name(c.name, yaml.where, diagnostics);
  for (const Choice& other : axis.choices)
    if (other.name == c.name)
      diagnostics.add(yaml.where, fmt::format("a second value of '{}' is named '{}'; give one "
                                              "another 'name'",
                                              axis.name, c.name));
  axis.choices.push_back(std::move(c));
}

}  // namespace

std::optional<Axis> parse_axis(const Yaml& key, const Yaml& values, const Pipeline& base,
                               Diagnostics& diagnostics) {
  static const std::regex form(R"(([a-z]+)(?:\[([1-9][0-9]{0,3})\])?)");
  std::smatch match;
  Axis axis;
  axis.name = key.scalar;
  if (std::regex_match(key.scalar, match, form)) {
    axis.verb = find_verb(match[1]);
    axis.only = match[2].matched ? std::stoi(match[2]) : 0;
  }
  if (!axis.verb) {
    diagnostics.add(key.where,
                    fmt::format("an axis must be a verb such as 'register' or 'recognize[2]', "
                                "found '{}'{}",
                                key.scalar, suggestion(key.scalar, verb_words())));
    return std::nullopt;
  }
  const auto steps = std::count_if(base.steps.begin(), base.steps.end(),
                                   [&](const StepSpec& s) { return s.verb == axis.verb; });
  if (steps < std::max(axis.only, 1))
    diagnostics.add(key.where,
                    fmt::format("the base pipeline has {} step(s) '{}'", steps, axis.verb->word));
  if (!values.is_list() || values.list.empty())
    diagnostics.add(values.where, "an axis must be a list of plugins, found " + values.shown());
  for (const Yaml& v : values.list) add_choice(v, axis, diagnostics);
  return axis;
}

void check_name(const std::string& name, const std::string& where, Diagnostics& diagnostics) {
  static const std::regex form(R"([A-Za-z0-9_][A-Za-z0-9_.\-]*)");
  if (!std::regex_match(name, form))
    diagnostics.add(where, fmt::format("'{}' cannot be a name here: use letters, digits, '_', '-' "
                                       "and '.'",
                                       name));
}

}  // namespace cambium::matrix
