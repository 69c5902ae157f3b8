// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "conformance/law.hpp"
#include "pipeline/binder.hpp"
#include "pipeline/params.hpp"

namespace cambium::conformance {
namespace {

void documented(const Subject& subject) {
  for (const ParamInfo& p : list_params(*subject.registered.create()))
    require(p.doc.size() >= 8,
            fmt::format("parameter '{}' has the line '{}'; expected one that helps a user decide",
                        p.name, p.doc));
  require(!subject.registered.summary.empty(),
          "has no summary; 'cambium plugins list' shows an empty line");
}

void unique_names(const Subject& subject) {
  const auto params = list_params(*subject.registered.create());
  for (std::size_t i = 0; i < params.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      require(params[i].name != params[k].name,
              fmt::format("parameter '{}' is declared twice", params[i].name));
}

/// A fresh component with its own defaults written and read back.
std::unique_ptr<Component> rebound(const Subject& subject, Diagnostics& diagnostics) {
  auto component = subject.registered.create();
  const std::string text = canonical_params(*component);
  bind_params(*component, parse_yaml(text, "defaults", diagnostics), diagnostics);
  return component;
}

void sound_defaults(const Subject& subject) {
  Diagnostics diagnostics;
  rebound(subject, diagnostics);
  try {
    diagnostics.throw_if_any();
  } catch (const Error& e) {
    throw Broken(fmt::format("the defaults break the component's own bounds: {}", e.what()));
  }
}

void round_trip(const Subject& subject) {
  Diagnostics diagnostics;
  const std::string text = canonical_params(*subject.registered.create());
  const std::string again = canonical_params(*rebound(subject, diagnostics));
  require(text == again,
          fmt::format("parameters written and read back differ:\n  {}\n  {}", text, again));
}

void unknown_keys(const Subject& subject) {
  Diagnostics diagnostics;
  bind_params(*subject.registered.create(),
              parse_yaml("no_such_parameter_: 1", "test", diagnostics), diagnostics);
  require(!diagnostics.empty(), "took a parameter that it does not have");
}

}  // namespace

std::vector<Law> parameter_laws() {
  return {{"documents its parameters", documented},
          {"declares each parameter once", unique_names},
          {"has defaults within its own bounds", sound_defaults},
          {"reads back the parameters that it writes", round_trip},
          {"refuses parameters that it does not have", unknown_keys}};
}

}  // namespace cambium::conformance
