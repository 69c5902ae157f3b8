// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/overrides.hpp"

#include <fmt/format.h>

#include <regex>

namespace cambium {

namespace {

void place_everywhere(Yaml& y, const std::string& where) {
  y.where = where;
  for (auto& e : y.list) place_everywhere(e, where);
  for (auto& e : y.map) place_everywhere(e.value, where);
}

}  // namespace

std::optional<Setting> parse_setting(const std::string& text, const std::string& form,
                                     Diagnostics& diagnostics) {
  const std::string where = "--set " + text;
  const auto split = text.find('=');
  if (split == std::string::npos) {
    diagnostics.add(where, "expected " + form + ", found no '='");
    return std::nullopt;
  }
  Setting out;
  out.name.type = Yaml::Type::scalar;
  out.name.scalar = text.substr(0, split);
  out.name.where = where;
  out.value = parse_yaml(text.substr(split + 1), where, diagnostics);
  place_everywhere(out.value, where);
  return out;
}

void apply_override(Pipeline& pipeline, const Yaml& key, const Yaml& value,
                    Diagnostics& diagnostics) {
  static const std::regex form(R"(([a-z_]+)(?:\[([0-9]{1,6})\])?\.([A-Za-z0-9_]+))");
  std::smatch match;
  if (!std::regex_match(key.scalar, match, form)) {
    diagnostics.add(key.where,
                    fmt::format("'{}' is not of the form VERB.PARAM or VERB[n].PARAM", key.scalar));
    return;
  }
  const std::string word = match[1];
  const int only = match[2].matched ? std::stoi(match[2]) : 0;
  if (!find_verb(word)) {
    diagnostics.add(key.where,
                    fmt::format("unknown verb '{}'{}", word, suggestion(word, verb_words())));
    return;
  }
  Yaml name = key;
  name.scalar = match[3];
  int count = 0, used = 0;
  for (auto& step : pipeline.steps) {
    if (step.verb->word != word || (++count != only && only != 0)) continue;
    step.params.set(name, value);
    ++used;
  }
  if (used == 0)
    diagnostics.add(key.where,
                    fmt::format("the pipeline has {} step(s) '{}'; nothing to set", count, word));
}

void apply_override(Pipeline& pipeline, const std::string& text, Diagnostics& diagnostics) {
  if (const auto s = parse_setting(text, "VERB.PARAM=VALUE", diagnostics))
    apply_override(pipeline, s->name, s->value, diagnostics);
}

}  // namespace cambium
