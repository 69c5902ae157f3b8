// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>

#include "cambium/files.hpp"
#include "matrix/axis.hpp"
#include "matrix/selection.hpp"
#include "pipeline/binder.hpp"
#include "pipeline/overrides.hpp"
#include "pipeline/params.hpp"

namespace cambium::matrix {
namespace {

class Reader {
 public:
  Reader(Diagnostics& diagnostics, Form form) : diagnostics_(diagnostics), form_(form) {}

  void read(const Yaml& doc, Spec& spec) {
    bind_own_keys(doc, spec);
    const Yaml* version = doc.find("version");
    if (!version || version->as_int() != 1)
      diagnostics_.add(version ? version->where : doc.where, "expected 'version: 1'");
    read_base(doc, spec);
    for (const Yaml& d : list(doc, "datasets")) read_dataset(d, spec);
    if (spec.datasets.empty())
      diagnostics_.add(doc.where, "'datasets' must be a list of one dataset or more");
    for (const auto& [key, value] : map(doc, "axes"))
      if (auto axis = parse_axis(key, value, spec.base, diagnostics_))
        spec.axes.push_back(std::move(*axis));
    for (const Yaml& e : list(doc, "exclude"))
      spec.exclude.push_back(parse_selection(e, spec, diagnostics_));
    for (const Yaml& e : list(doc, "expect")) read_expectation(e, spec);
    for (const auto& [key, value] : map(doc, "tolerances")) {
      Tolerance& t = spec.tolerances.emplace_back();
      t.pattern = key.scalar;
      bind_params(t, value, diagnostics_);
    }
  }

 private:
  // What Spec declares is bound to it; the structured keys are read one by one.
  void bind_own_keys(const Yaml& doc, Spec& spec) {
    std::vector<std::string> structured = {"version", "datasets", "expect", "set"};
    if (form_ == Form::matrix)
      structured.insert(structured.end(), {"axes", "exclude", "tolerances"});
    std::vector<std::string> known = structured;
    for (const ParamInfo& p : list_params(spec))
      if (form_ == Form::matrix || p.name != "baseline") known.push_back(p.name);
    check_keys(doc, known, form_ == Form::matrix ? "the matrix" : "the batch", diagnostics_);
    Yaml own = doc;
    std::erase_if(own.map, [&](const Yaml::Item& i) {
      return contains(structured, i.key.scalar) || !contains(known, i.key.scalar);
    });
    bind_params(spec, own, diagnostics_);
  }

  void read_base(const Yaml& doc, Spec& spec) {
    if (spec.pipeline.empty())
      return diagnostics_.add(doc.where, "'pipeline' is missing; expected the base pipeline");
    spec.base = load_pipeline(spec.beside(spec.pipeline));
    for (const auto& [key, value] : map(doc, "set"))
      apply_override(spec.base, key, value, diagnostics_);
  }

  void read_dataset(const Yaml& yaml, Spec& spec) {
    Dataset d;
    bind_params(d, yaml, diagnostics_);
    check_name(d.name, yaml.where, diagnostics_);
    for (const Dataset& other : spec.datasets)
      if (other.name == d.name)
        diagnostics_.add(yaml.where, fmt::format("a second dataset is named '{}'", d.name));
    if (d.archive.empty())
      for (std::string& m : d.missions) m = spec.beside(m).string();
    for (std::string* path : {&d.archive, &d.simulate})
      if (!path->empty()) *path = spec.beside(*path).string();
    spec.datasets.push_back(std::move(d));
  }

  void read_expectation(const Yaml& yaml, Spec& spec) {
    check_keys(yaml, {"metric", "at_least", "at_most", "where"}, "an expectation", diagnostics_);
    Expectation e;
    if (const Yaml* metric = yaml.find("metric")) e.metric = metric->scalar;
    if (e.metric.empty())
      diagnostics_.add(yaml.where, "an expectation needs a 'metric' such as ate.rmse");
    if (!yaml.find("at_least") && !yaml.find("at_most"))
      diagnostics_.add(yaml.where, "an expectation needs 'at_least', 'at_most' or both");
    read_bound(yaml, "at_least", e.at_least);
    read_bound(yaml, "at_most", e.at_most);
    if (const Yaml* where = yaml.find("where"))
      e.where = parse_selection(*where, spec, diagnostics_);
    spec.expect.push_back(std::move(e));
  }

  void read_bound(const Yaml& yaml, const char* key, double& bound) {
    const Yaml* value = yaml.find(key);
    if (!value) return;
    if (const auto number = value->as_double())
      bound = *number;
    else
      diagnostics_.add(value->where,
                       fmt::format("'{}' must be a number, found {}", key, value->shown()));
  }

  const std::vector<Yaml>& list(const Yaml& doc, const char* key) {
    static const std::vector<Yaml> none;
    const Yaml* value = doc.find(key);
    if (!value) return none;
    if (!value->is_list())
      diagnostics_.add(value->where,
                       fmt::format("'{}' must be a list, found {}", key, value->shown()));
    return value->list;
  }

  const std::vector<Yaml::Item>& map(const Yaml& doc, const char* key) {
    static const std::vector<Yaml::Item> none;
    const Yaml* value = doc.find(key);
    if (!value) return none;
    if (!value->is_map())
      diagnostics_.add(value->where,
                       fmt::format("'{}' must be a map, found {}", key, value->shown()));
    return value->map;
  }

  Diagnostics& diagnostics_;
  Form form_;
};

}  // namespace

Spec load_spec(const std::filesystem::path& file, Form form) {
  Diagnostics diagnostics;
  const Yaml doc = parse_yaml(read_file(file), file.string(), diagnostics);
  if (!doc.is_map())
    diagnostics.add(
        file.string(),
        "expected a map with 'version', 'pipeline' and 'datasets', found " + doc.shown());
  diagnostics.throw_if_any();
  Spec spec;
  spec.file = file;
  Reader(diagnostics, form).read(doc, spec);
  diagnostics.throw_if_any();
  return spec;
}

}  // namespace cambium::matrix
