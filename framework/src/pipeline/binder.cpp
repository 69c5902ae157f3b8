// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/binder.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <regex>

#include "pipeline/params.hpp"

namespace cambium {
namespace {

// Paths in a file start from its folder, those of the command line from the current one.
std::filesystem::path absolute_file(const Yaml& name) {
  static const std::regex in_file("(.*):[0-9]+:[0-9]+");
  std::smatch match;
  std::filesystem::path folder;
  if (std::regex_match(name.where, match, in_file))
    folder = std::filesystem::path(match[1].str()).parent_path();
  return std::filesystem::absolute(folder / name.scalar).lexically_normal();
}

class Binder final : public ParamVisitor {
 public:
  Binder(const Yaml& params, Diagnostics& diagnostics)
      : params_(params), diagnostics_(diagnostics) {}

  void visit(const char* name, bool& v, const char*, const Constraint&) override {
    set_scalar(name, v, &Yaml::as_bool, "true or false", {});
  }
  void visit(const char* name, std::int64_t& v, const char*, const Constraint& c) override {
    set_scalar(name, v, &Yaml::as_int, "a whole number", c);
  }
  void visit(const char* name, double& v, const char*, const Constraint& c) override {
    set_scalar(name, v, &Yaml::as_double, "a number", c);
  }
  void visit(const char* name, std::string& v, const char*, const Constraint& c) override {
    if (const Yaml* n = take(name)) bind_string(name, *n, v, c);
  }
  void visit(const char* name, std::vector<double>& v, const char*, const Constraint& c) override {
    set_list(name, v, [&](const Yaml& n, double& e) {
      bind_number(name, n, e, n.as_double(), "a number", c);
    });
  }
  void visit(const char* name, std::vector<std::string>& v, const char*,
             const Constraint& c) override {
    set_list(name, v, [&](const Yaml& n, std::string& e) { bind_string(name, n, e, c); });
  }

  void report_unknown() {
    for (const auto& [key, value] : params_.map)
      if (std::find(known_.begin(), known_.end(), key.scalar) == known_.end())
        diagnostics_.add(key.where, fmt::format("unknown parameter '{}'{}", key.scalar,
                                                suggestion(key.scalar, known_)));
  }

 private:
  const Yaml* take(const char* name) {
    known_.push_back(name);
    return params_.find(name);
  }

  template <class T>
  void set_scalar(const char* name, T& v, std::optional<T> (Yaml::*read)() const,
                  const char* expected, const Constraint& c) {
    if (const Yaml* n = take(name)) bind_number(name, *n, v, (n->*read)(), expected, c);
  }

  template <class T>
  void bind_number(const char* name, const Yaml& n, T& v, const std::optional<T>& parsed,
                   const char* expected, const Constraint& c) {
    if (!parsed) {
      diagnostics_.add(n.where,
                       fmt::format("'{}' must be {}, found {}", name, expected, n.shown()));
      return;
    }
    const std::string wrong = violation(double(*parsed), c);
    if (!wrong.empty())
      diagnostics_.add(n.where, fmt::format("'{}' {}", name, wrong));
    else
      v = *parsed;
  }

  void bind_string(const char* name, const Yaml& n, std::string& v, const Constraint& c) {
    if (!n.is_scalar()) {
      diagnostics_.add(n.where, fmt::format("'{}' must be a text, found {}", name, n.shown()));
    } else if (!c.choices.empty() &&
               std::find(c.choices.begin(), c.choices.end(), n.scalar) == c.choices.end()) {
      diagnostics_.add(n.where, fmt::format("'{}' cannot be '{}'{}", name, n.scalar,
                                            suggestion(n.scalar, c.choices)));
    } else if (is_file(c) && !n.scalar.empty()) {
      const auto file = absolute_file(n);
      if (std::filesystem::is_regular_file(file))
        v = file.string();
      else
        diagnostics_.add(n.where, fmt::format("'{}': there is no file '{}'", name, file.string()));
    } else {
      v = n.scalar;
    }
  }

  template <class T, class BindElement>
  void set_list(const char* name, std::vector<T>& v, BindElement bind) {
    const Yaml* n = take(name);
    if (!n) return;
    if (!n->is_list()) {
      diagnostics_.add(n->where, fmt::format("'{}' must be a list, found {}", name, n->shown()));
      return;
    }
    v.assign(n->list.size(), T{});
    for (std::size_t i = 0; i < v.size(); ++i) bind(n->list[i], v[i]);
  }

  const Yaml& params_;
  Diagnostics& diagnostics_;
  std::vector<std::string> known_;
};

}  // namespace

std::string to_text(const Constraint& c) {
  if (!c.choices.empty()) return fmt::format("one of {}", fmt::join(c.choices, ", "));
  if (is_file(c)) return "a file, or none";
  const bool low = std::isfinite(c.low) && c.low > std::numeric_limits<int>::min();
  const bool high = std::isfinite(c.high) && c.high < std::numeric_limits<int>::max();
  std::string text;
  if (low && high)
    text = fmt::format("{} {} value {} {}", c.low,
                       c.low_open ? "<" : "<=", c.high_open ? "<" : "<=", c.high);
  else if (low)
    text = fmt::format("{} {}", c.low_open ? "above" : "at least", c.low);
  else if (high)
    text = fmt::format("{} {}", c.high_open ? "below" : "at most", c.high);
  return text.empty() || c.unit.empty() ? text : text + " " + c.unit;
}

std::string violation(double value, const Constraint& c) {
  const bool too_low = c.low_open ? !(value > c.low) : !(value >= c.low);
  const bool too_high = c.high_open ? !(value < c.high) : !(value <= c.high);
  if (!too_low && !too_high) return {};
  return fmt::format("must satisfy {}, found {}", to_text(c), value);
}

void bind_params(Component& component, const Yaml& params, Diagnostics& diagnostics) {
  if (!params.is_null() && !params.is_map()) {
    diagnostics.add(params.where, "params must be a map, found " + params.shown());
    return;
  }
  Binder binder(params, diagnostics);
  component.params(binder);
  binder.report_unknown();
  const std::string wrong = component.check_params();
  if (!wrong.empty()) diagnostics.add(params.where, wrong);
}

}  // namespace cambium
