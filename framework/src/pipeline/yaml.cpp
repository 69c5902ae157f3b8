// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/yaml.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include <nlohmann/json.hpp>

namespace cambium {
namespace {

template <class T>
std::optional<T> parse_number(const Yaml& y) {
  if (!y.is_scalar() || y.quoted || y.scalar.empty()) return std::nullopt;
  const char* begin = y.scalar.data() + (y.scalar.size() > 1 && y.scalar[0] == '+' ? 1 : 0);
  const char* const end = y.scalar.data() + y.scalar.size();
  T value{};
  const auto [stop, error] = std::from_chars(begin, end, value);
  if (error != std::errc{} || stop != end) return std::nullopt;
  return value;
}

}  // namespace

const Yaml* Yaml::find(const std::string& key) const {
  for (const auto& item : map)
    if (item.key.scalar == key) return &item.value;
  return nullptr;
}

void Yaml::set(const Yaml& key, const Yaml& value) {
  type = Type::map;
  for (auto& item : map)
    if (item.key.scalar == key.scalar) {
      item = {key, value};
      return;
    }
  map.push_back({key, value});
}

std::optional<bool> Yaml::as_bool() const {
  if (!is_scalar() || quoted) return std::nullopt;
  if (scalar == "true") return true;
  if (scalar == "false") return false;
  return std::nullopt;
}

std::optional<std::int64_t> Yaml::as_int() const { return parse_number<std::int64_t>(*this); }

std::optional<double> Yaml::as_double() const {
  const auto value = parse_number<double>(*this);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

std::string Yaml::shown() const {
  switch (type) {
    case Type::null:
      return "nothing";
    case Type::list:
      return "a list";
    case Type::map:
      return "a map";
    case Type::scalar:
      break;
  }
  return fmt::format("'{}'", scalar);
}

std::string to_flow(const Yaml& y) {
  const auto quoted = [](const std::string& text) { return nlohmann::json(text).dump(); };
  std::string out;
  switch (y.type) {
    case Yaml::Type::null:
      return "null";
    case Yaml::Type::scalar:
      // Quotes would make texts of numbers and of true and false.
      return !y.quoted && (y.as_double() || y.as_bool()) ? y.scalar : quoted(y.scalar);
    case Yaml::Type::list:
      for (const Yaml& e : y.list) out += (out.empty() ? "" : ", ") + to_flow(e);
      return "[" + out + "]";
    case Yaml::Type::map:
      for (const auto& [key, value] : y.map)
        out += (out.empty() ? "" : ", ") + quoted(key.scalar) + ": " + to_flow(value);
      break;
  }
  return "{" + out + "}";
}

Yaml merged(Yaml base, const Yaml& over) {
  for (const auto& item : over.map) base.set(item.key, item.value);
  return base;
}

void check_keys(const Yaml& map, const std::vector<std::string>& known, const std::string& of,
                Diagnostics& diagnostics) {
  for (const auto& [key, value] : map.map)
    if (std::find(known.begin(), known.end(), key.scalar) == known.end())
      diagnostics.add(key.where, fmt::format("unknown key '{}' in {}{}", key.scalar, of,
                                             suggestion(key.scalar, known)));
}

}  // namespace cambium
