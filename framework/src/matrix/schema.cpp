// SPDX-License-Identifier: BSD-3-Clause
#include "matrix/schema.hpp"

#include "matrix/spec.hpp"
#include "pipeline/params.hpp"

namespace cambium::matrix {
namespace {

using Json = nlohmann::ordered_json;

Json object(const Json& properties, const Json& required, const char* description = "") {
  Json out{{"type", "object"}, {"additionalProperties", false}, {"properties", properties}};
  if (!required.empty()) out["required"] = required;
  if (*description) out["description"] = description;
  return out;
}

Json axis_schema(const Verb& verb, const Registry& registry) {
  Json names = Json::array(), values = Json::array();
  for (const auto& [key, component] : registry.all()) {
    if (key.first != verb.kind) continue;
    names.push_back(component.name);
    values.push_back(object({{"plugin", {{"const", component.name}}},
                             {"name", {{"type", "string"}}},
                             {"params", params_schema(*component.create())}},
                            {"plugin"}));
  }
  values.insert(values.begin(), Json{{"enum", names}});
  return {{"type", "array"}, {"minItems", 1}, {"items", {{"anyOf", values}}}};
}

// `register` stands for every step of the verb, `register[2]` for the second.
Json axes_schema(const Registry& registry) {
  Json patterns = Json::object();
  for (const Verb& verb : verbs())
    patterns["^" + verb.word + "(\\[[1-9][0-9]*\\])?$"] = axis_schema(verb, registry);
  return {{"type", "object"},
          {"description", "For a verb of the base pipeline, the plugins to try"},
          {"additionalProperties", false},
          {"patternProperties", patterns}};
}

Json selection_schema() {
  const Json text{{"type", "string"}};
  return {{"type", "object"},
          {"minProperties", 1},
          {"description", "Cells by their values, such as {register: gicp, dataset: [a, b]}"},
          {"additionalProperties", {{"anyOf", {text, {{"type", "array"}, {"items", text}}}}}}};
}

Json expect_schema() {
  const Json number{{"type", "number"}};
  return object({{"metric", {{"type", "string"}}},
                 {"at_least", number},
                 {"at_most", number},
                 {"where", selection_schema()}},
                {"metric"}, "A bound that must hold for the cells meant by 'where', or for all");
}

}  // namespace

Json matrix_schema(const Registry& registry) {
  Spec spec;
  Dataset dataset;
  Tolerance tolerance;
  Json properties{{"version", {{"const", 1}}}};
  const Json own = params_schema(spec);
  for (const auto& [name, schema] : own["properties"].items()) properties[name] = schema;
  Json item = params_schema(dataset);
  item["required"] = {"name"};
  properties["datasets"] = {{"type", "array"}, {"minItems", 1}, {"items", item}};
  properties["axes"] = axes_schema(registry);
  properties["exclude"] = {{"type", "array"}, {"items", selection_schema()}};
  properties["expect"] = {{"type", "array"}, {"items", expect_schema()}};
  properties["tolerances"] = {
      {"type", "object"},
      {"description", "By name of metric or glob; the first that fits holds"},
      {"additionalProperties", params_schema(tolerance)}};
  properties["set"] = {{"type", "object"},
                       {"description", "VERB.PARAM: value, on top of the base pipeline"}};
  Json out{{"$schema", "http://json-schema.org/draft-07/schema#"}, {"title", "Cambium matrix"}};
  out.update(object(properties, {"version", "pipeline", "datasets"}));
  return out;
}

}  // namespace cambium::matrix
