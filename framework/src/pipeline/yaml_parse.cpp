// SPDX-License-Identifier: BSD-3-Clause
// From text to Yaml, with what yaml-cpp lets pass: duplicate keys, several documents, floods.
#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <sstream>

#include "cambium/error.hpp"
#include "pipeline/yaml.hpp"

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

}  // namespace

Yaml parse_yaml(const std::string& text, const std::string& file, Diagnostics& diagnostics) {
  try {
    check_one_document(text, file, diagnostics);
    return Converter(file, diagnostics).convert(YAML::Load(text), 0);
  } catch (const YAML::Exception& e) {
    throw Error(ErrorCode::config, place(file, e.mark), "not valid YAML: " + e.msg);
  }
}

}  // namespace cambium
