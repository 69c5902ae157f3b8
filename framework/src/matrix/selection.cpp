// SPDX-License-Identifier: BSD-3-Clause
#include "matrix/selection.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace cambium::matrix {

bool contains(const std::vector<std::string>& list, const std::string& value) {
  return std::find(list.begin(), list.end(), value) != list.end();
}

namespace {

std::vector<std::string> axis_names(const Spec& spec) {
  std::vector<std::string> names = {"dataset"};
  for (const Axis& axis : spec.axes) names.push_back(axis.name);
  return names;
}

std::vector<std::string> values_of(const std::string& axis, const Spec& spec) {
  std::vector<std::string> out;
  if (axis == "dataset")
    for (const Dataset& d : spec.datasets) out.push_back(d.name);
  for (const Axis& a : spec.axes)
    if (a.name == axis)
      for (const Choice& c : a.choices) out.push_back(c.name);
  return out;
}

}  // namespace

Selection parse_selection(const Yaml& yaml, const Spec& spec, Diagnostics& diagnostics) {
  if (!yaml.is_map() || yaml.map.empty()) {
    diagnostics.add(yaml.where, "expected a map such as {register: gicp}, found " + yaml.shown());
    return {};
  }
  Selection out;
  for (const auto& [axis, value] : yaml.map) {
    if (!contains(axis_names(spec), axis.scalar)) {
      diagnostics.add(axis.where, fmt::format("unknown axis '{}'{}", axis.scalar,
                                              suggestion(axis.scalar, axis_names(spec))));
      continue;
    }
    const auto known = values_of(axis.scalar, spec);
    auto& wanted = out.emplace_back(axis.scalar, std::vector<std::string>{}).second;
    for (const Yaml& v : value.is_list() ? value.list : std::vector<Yaml>{value}) {
      wanted.push_back(v.scalar);
      if (!contains(known, v.scalar))
        diagnostics.add(v.where, fmt::format("'{}' has no value {}{}", axis.scalar, v.shown(),
                                             suggestion(v.scalar, known)));
    }
  }
  return out;
}

bool selects(const Selection& selection,
             const std::vector<std::pair<std::string, std::string>>& choices) {
  return std::all_of(selection.begin(), selection.end(), [&](const auto& wanted) {
    return std::any_of(choices.begin(), choices.end(), [&](const auto& choice) {
      return choice.first == wanted.first && contains(wanted.second, choice.second);
    });
  });
}

}  // namespace cambium::matrix
