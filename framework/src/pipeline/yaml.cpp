// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/yaml.hpp"

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

#include <nlohmann/json.hpp>

#include "cambium/error.hpp"

namespace cambium {
namespace {

constexpr int max_depth = 64;  // deeper documents are attacks, not pipelines

std::string place(const std::string& file, const YAML::Mark& mark) {
  return mark.line < 0 ? file : fmt::format("{}:{}:{}", file, mark.line + 1, mark.column + 1);
}

class Converter {
 public:
  Converter(const std::string& file, Diagnostics& diagnostics)
      : file_(file), diagnostics_(diagnostics) {}

  Yaml convert(const YAML::Node& node, int depth) {
    Yaml out;
    out.where = place(file_, node.Mark());
    if (depth > max_depth)
      throw Error(ErrorCode::config, out.where,
                  fmt::format("nested deeper than {} levels", max_depth));
    if (++count_ > 1'000'000)  // aliases can blow a small file up without end
      throw Error(ErrorCode::config, out.where, "more than a million values; expand fewer aliases");
    if (node.IsScalar()) {
      out.type = Yaml::Type::scalar;
      out.scalar = node.Scalar();
      out.quoted = node.Tag() == "!";
    } else if (node.IsSequence()) {
      out.type = Yaml::Type::list;
      for (const auto& item : node) out.list.push_back(convert(item, depth + 1));
    } else if (node.IsMap()) {
      out.type = Yaml::Type::map;
      for (const auto& item : node) add_item(out, item.first, item.second, depth + 1);
    }
    return out;
  }

 private:
  void add_item(Yaml& out, const YAML::Node& key, const YAML::Node& value, int depth) {
    Yaml k = convert(key, depth);
    if (!k.is_scalar()) {
      diagnostics_.add(k.where, "a key must be a text, found " + k.shown());
      return;
    }
    const auto same = std::find_if(out.map.begin(), out.map.end(),
                                   [&](const Yaml::Item& i) { return i.key.scalar == k.scalar; });
    if (same != out.map.end())
      diagnostics_.add(
          k.where, fmt::format("duplicate key '{}', first given at {}", k.scalar, same->key.where));
    else
      out.map.push_back({std::move(k), convert(value, depth)});
  }

  const std::string& file_;
  Diagnostics& diagnostics_;
  std::size_t count_ = 0;
};

// Notices where a document begins, and nothing else.
class DocumentStart final : public YAML::EventHandler {
 public:
  YAML::Mark mark;
  void OnDocumentStart(const YAML::Mark& m) override { mark = m; }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark&, YAML::anchor_t) override {}
  void OnAlias(const YAML::Mark&, YAML::anchor_t) override {}
  void OnScalar(const YAML::Mark&, const std::string&, YAML::anchor_t,
                const std::string&) override {}
  void OnSequenceStart(const YAML::Mark&, const std::string&, YAML::anchor_t,
                       YAML::EmitterStyle::value) override {}
  void OnSequenceEnd() override {}
  void OnMapStart(const YAML::Mark&, const std::string&, YAML::anchor_t,
                  YAML::EmitterStyle::value) override {}
  void OnMapEnd() override {}
};

// Not YAML::LoadAll: on a stray ',' it finds empty documents without end.
void check_one_document(const std::string& text, const std::string& file,
                        Diagnostics& diagnostics) {
  std::istringstream stream(text);
  YAML::Parser parser(stream);
  DocumentStart document;
  if (parser.HandleNextDocument(document) && parser.HandleNextDocument(document))
    diagnostics.add(place(file, document.mark),
                    "a second document begins here, or something that "
                    "belongs to none; expected one document");
}

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

Yaml parse_yaml(const std::string& text, const std::string& file, Diagnostics& diagnostics) {
  try {
    check_one_document(text, file, diagnostics);
    return Converter(file, diagnostics).convert(YAML::Load(text), 0);
  } catch (const YAML::Exception& e) {
    throw Error(ErrorCode::config, place(file, e.mark), "not valid YAML: " + e.msg);
  }
}

void check_keys(const Yaml& map, const std::vector<std::string>& known, const std::string& of,
                Diagnostics& diagnostics) {
  for (const auto& [key, value] : map.map)
    if (std::find(known.begin(), known.end(), key.scalar) == known.end())
      diagnostics.add(key.where, fmt::format("unknown key '{}' in {}{}", key.scalar, of,
                                             suggestion(key.scalar, known)));
}

}  // namespace cambium
