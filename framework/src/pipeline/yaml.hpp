// SPDX-License-Identifier: BSD-3-Clause
// Strict YAML. Every value knows where it stands, across files and command line; what yaml-cpp lets
// pass (duplicate keys) is an error, and a plain scalar has one type.
#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "pipeline/diagnostics.hpp"

namespace cambium {

struct Yaml {
  enum class Type { null, scalar, list, map };
  struct Item;

  Type type = Type::null;
  std::string scalar;
  bool quoted = false;  ///< a quoted "20" is a text, not a number
  std::vector<Yaml> list;
  std::vector<Item> map;  ///< in the order of the file
  std::string where;      ///< file:line:col, or the command line option

  bool is_null() const { return type == Type::null; }
  bool is_scalar() const { return type == Type::scalar; }
  bool is_list() const { return type == Type::list; }
  bool is_map() const { return type == Type::map; }
  const Yaml* find(const std::string& key) const;  ///< null when absent
  void set(const Yaml& key, const Yaml& value);    ///< replaces or appends

  std::optional<bool> as_bool() const;  ///< nothing when the value is of another type
  std::optional<std::int64_t> as_int() const;
  std::optional<double> as_double() const;  ///< finite
  std::string shown() const;  ///< how it appears in a message: 'abc', a list, a map, nothing
};

struct Yaml::Item {
  Yaml key, value;
};

/// The value on one line; reads back as the same value.
std::string to_flow(const Yaml& yaml);

/// `base` with the keys of `over` on top.
Yaml merged(Yaml base, const Yaml& over);

/// Parses one document; `file` names it in messages. A syntax error throws Error(config); other
/// mistakes go to `diagnostics`.
Yaml parse_yaml(const std::string& text, const std::string& file, Diagnostics& diagnostics);

/// Reports keys of `map` that are not in `known`; `of` says what the map is.
void check_keys(const Yaml& map, const std::vector<std::string>& known, const std::string& of,
                Diagnostics& diagnostics);

}  // namespace cambium
