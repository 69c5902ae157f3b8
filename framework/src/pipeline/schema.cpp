// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/schema.hpp"

#include "pipeline/params.hpp"
#include "pipeline/verbs.hpp"

namespace cambium {
namespace {

using Json = nlohmann::ordered_json;

Json step_schema(const Verb& verb, const Registered& component) {
  StepKeys keys(&verb);
  Json properties = Json::object();
  properties[verb.word] = {{"const", component.name}, {"description", component.summary}};
  const auto own_keys = params_schema(keys);
  for (const auto& [name, schema] : own_keys["properties"].items()) properties[name] = schema;
  properties["params"] = params_schema(*component.create());
  return {{"type", "object"},
          {"required", {verb.word}},
          {"additionalProperties", false},
          {"properties", properties}};
}

Json steps_schema(const Registry& registry) {
  Json any = Json::array();
  for (const Verb& verb : verbs())
    for (const auto& [key, component] : registry.all())
      if (key.first == verb.kind) any.push_back(step_schema(verb, component));
  return {{"type", "array"}, {"items", {{"anyOf", any}}}};
}

Json mission_schema() {
  const Json map{{"type", "object"},
                 {"required", {"path"}},
                 {"additionalProperties", false},
                 {"properties",
                  {{"path", {{"type", "string"}}},
                   {"name", {{"type", "string"}}},
                   {"reader", {{"type", "string"}}},
                   {"params", {{"type", "object"}}}}}};
  return {{"type", "array"},
          {"description", "Folders, .g2o files or globs, relative to this file"},
          {"items", {{"anyOf", {{{"type", "string"}}, map}}}}};
}

Json platforms_schema() {
  Json verbs_of = Json::object();
  const Json body{{"type", "object"},
                  {"additionalProperties", false},
                  {"properties", {{"params", {{"type", "object"}}}}}};
  for (const Verb& verb : verbs())
    if (verb.per_platform) verbs_of[verb.word] = body;
  return {{"type", "object"},
          {"description", "Overrides by PLATFORM_ID"},
          {"additionalProperties",
           {{"type", "object"}, {"additionalProperties", false}, {"properties", verbs_of}}}};
}

}  // namespace

Json pipeline_schema(const Registry& registry) {
  const Json properties{
      {"version", {{"const", 1}}},
      {"extends", {{"type", "string"}, {"description", "Another pipeline to start from"}}},
      {"seed", {{"type", "integer"}, {"minimum", 0}, {"default", 1}}},
      {"missions", mission_schema()},
      {"steps", steps_schema(registry)},
      {"platforms", platforms_schema()},
      {"set",
       {{"type", "object"}, {"description", "VERB.PARAM: value, on top of what is extended"}}}};
  return {{"$schema", "http://json-schema.org/draft-07/schema#"},
          {"title", "Cambium pipeline"},
          {"type", "object"},
          {"required", {"version"}},
          {"additionalProperties", false},
          {"properties", properties}};
}

}  // namespace cambium
