// SPDX-License-Identifier: BSD-3-Clause
// `params()` is the only declaration of a parameter: YAML binding, bounds, schema, docs and the
// cache key come from it. Defaults are the member initialisers.
#pragma once
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace cambium {

/// What a value must satisfy, and its unit. Also shown in the schema and in the docs.
struct Constraint {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_open = false, high_open = false;  ///< the limit itself is not allowed
  std::vector<std::string> choices;          ///< for strings; empty = anything
  std::string unit;
};

inline Constraint between(double low, double high, std::string unit = "") {
  return {low, high, false, false, {}, std::move(unit)};
}
inline Constraint above(double low, std::string unit = "") {
  return {low, std::numeric_limits<double>::infinity(), true, false, {}, std::move(unit)};
}
inline Constraint at_least(double low, std::string unit = "") {
  return {low, std::numeric_limits<double>::infinity(), false, false, {}, std::move(unit)};
}
inline Constraint one_of(std::vector<std::string> choices) {
  Constraint c;
  c.choices = std::move(choices);
  return c;
}
inline Constraint in_unit(std::string unit) {
  Constraint c;
  c.unit = std::move(unit);
  return c;
}

/// Implemented by the framework (binding, schema, docs, canonical form), called by components.
class ParamVisitor {
 public:
  virtual ~ParamVisitor() = default;
  virtual void visit(const char* name, bool& v, const char* doc, const Constraint& c) = 0;
  virtual void visit(const char* name, std::int64_t& v, const char* doc, const Constraint& c) = 0;
  virtual void visit(const char* name, double& v, const char* doc, const Constraint& c) = 0;
  virtual void visit(const char* name, std::string& v, const char* doc, const Constraint& c) = 0;
  /// The constraint holds for every element.
  virtual void visit(const char* name, std::vector<double>& v, const char* doc,
                     const Constraint& c) = 0;
  virtual void visit(const char* name, std::vector<std::string>& v, const char* doc,
                     const Constraint& c) = 0;

  template <class T>
  void operator()(const char* name, T& value, const char* doc, const Constraint& c = {}) {
    visit(name, value, doc, c);
  }
  void operator()(const char* name, int& value, const char* doc, Constraint c = {}) {
    if (c.low < std::numeric_limits<int>::min()) c.low = std::numeric_limits<int>::min();
    if (c.high > std::numeric_limits<int>::max()) c.high = std::numeric_limits<int>::max();
    std::int64_t wide = value;
    visit(name, wide, doc, c);
    value = static_cast<int>(wide);
  }
};

}  // namespace cambium
