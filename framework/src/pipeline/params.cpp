// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/params.hpp"

#include <fmt/format.h>

#include <cmath>

#include "cambium/digest.hpp"
#include "pipeline/script_files.hpp"

namespace cambium {
namespace {

class Lister final : public ParamVisitor {
 public:
  std::vector<ParamInfo> list;

  void visit(const char* n, bool& v, const char* d, const Constraint& c) override {
    list.push_back({n, "boolean", d, v, c});
  }
  void visit(const char* n, std::int64_t& v, const char* d, const Constraint& c) override {
    list.push_back({n, "integer", d, v, c});
  }
  void visit(const char* n, double& v, const char* d, const Constraint& c) override {
    list.push_back({n, "number", d, v, c});
  }
  void visit(const char* n, std::string& v, const char* d, const Constraint& c) override {
    list.push_back({n, "string", d, v, c});
  }
  void visit(const char* n, std::vector<double>& v, const char* d, const Constraint& c) override {
    list.push_back({n, "list of number", d, v, c});
  }
  void visit(const char* n, std::vector<std::string>& v, const char* d,
             const Constraint& c) override {
    list.push_back({n, "list of string", d, v, c});
  }
};

nlohmann::ordered_json element_schema(const std::string& type, const Constraint& c) {
  nlohmann::ordered_json s{{"type", type}};
  if (!c.choices.empty()) s["enum"] = c.choices;
  const auto number = [&](double limit) -> nlohmann::ordered_json {
    if (type == "integer") return std::int64_t(limit);
    return limit;
  };
  if (std::isfinite(c.low)) s[c.low_open ? "exclusiveMinimum" : "minimum"] = number(c.low);
  if (std::isfinite(c.high)) s[c.high_open ? "exclusiveMaximum" : "maximum"] = number(c.high);
  return s;
}

std::string described(const ParamInfo& p) {
  return p.constraint.unit.empty() ? p.doc : fmt::format("{} [{}]", p.doc, p.constraint.unit);
}

}  // namespace

bool is_file(const Constraint& c) { return c.unit == "file" || declares_more(c); }
bool declares_more(const Constraint& c) { return c.unit == "script"; }

std::vector<ParamInfo> list_params(Component& component) {
  Lister lister;
  component.params(lister);
  return lister.list;
}

std::string canonical_params(Component& component) {
  // JSON is YAML's flow style, and nlohmann writes doubles so that they read back bit for bit.
  nlohmann::ordered_json map = nlohmann::ordered_json::object();
  for (const auto& p : list_params(component)) map[p.name] = p.value;
  return map.dump();
}

std::string identifying_params(Component& component) {
  nlohmann::ordered_json map = nlohmann::ordered_json::object();
  for (const auto& p : list_params(component)) {
    map[p.name] = p.value;
    if (!is_file(p.constraint) || p.value == "") continue;
    const auto file = p.value.get<std::string>();
    map[p.name] = (declares_more(p.constraint) ? digest_script(file) : digest_file(file)).hex();
  }
  return map.dump();
}

nlohmann::ordered_json params_schema(Component& component) {
  nlohmann::ordered_json properties = nlohmann::ordered_json::object();
  const std::string list = "list of ";
  bool more = false;
  for (const auto& p : list_params(component)) {
    nlohmann::ordered_json s;
    if (p.type.starts_with(list)) {
      s["type"] = "array";
      s["items"] = element_schema(p.type.substr(list.size()), p.constraint);
    } else {
      s = element_schema(p.type, p.constraint);
    }
    s["description"] = described(p);
    s["default"] = p.value;
    properties[p.name] = s;
    more |= declares_more(p.constraint);
  }
  return {{"type", "object"}, {"additionalProperties", more}, {"properties", properties}};
}

}  // namespace cambium
