// SPDX-License-Identifier: BSD-3-Clause
#include "results.hpp"

#include <pybind11/stl.h>

#include <cstring>

#include "arrays.hpp"

namespace cambium::python {
namespace {

std::string type_of(const py::handle& object) {
  return py::type::handle_of(object).attr("__name__").cast<std::string>();
}

template <class T>
T as(const py::handle& object, const std::string& what, const char* expected) try {
  return object.cast<T>();
} catch (const py::cast_error&) {
  throw std::runtime_error(what + ": expected " + expected + ", found a " + type_of(object));
}

py::list as_list(const py::object& returned, const std::string& what) {
  if (!py::isinstance<py::iterable>(returned))
    throw std::runtime_error(what + ": expected a list, found a " + type_of(returned));
  return py::list(returned);
}

Candidate to_candidate(const py::handle& item) {
  const std::string what = "match() returned a candidate";
  const auto parts = as<py::tuple>(item, what, "(query, reference, score[, T_reference_query])");
  if (parts.size() != 3 && parts.size() != 4)
    throw std::runtime_error(what + " of " + std::to_string(parts.size()) +
                             " values; expected (query, reference, score[, T_reference_query])");
  Candidate out;
  out.query = as<std::size_t>(parts[0], what + "'s query", "an index");
  out.reference = as<std::size_t>(parts[1], what + "'s reference", "an index");
  out.score = as<double>(parts[2], what + "'s score", "a number");
  if (parts.size() == 4 && !parts[3].is_none())
    out.T_reference_query = to_se3(parts[3], what + "'s guess");
  return out;
}

Better to_better(const std::string& word) {
  if (word == "lower") return Better::lower;
  if (word == "higher") return Better::higher;
  if (word == "neither") return Better::neither;
  throw std::runtime_error("evaluate() returned a metric that is better '" + word +
                           "'; expected lower, higher or neither");
}

}  // namespace

Payload to_payload(const py::object& returned, const std::string& what) {
  return as<Payload>(returned, what, "a Payload");
}

Fingerprints to_fingerprints(const py::object& returned, std::size_t nodes) {
  Fingerprints out;
  py::object table = returned;
  if (py::isinstance<py::tuple>(returned) && py::len(returned) == 2) {
    table = py::tuple(returned)[0];
    const auto extra =
        as<std::string>(py::tuple(returned)[1], "describe() returned extra", "bytes");
    out.extra.resize(extra.size());
    std::memcpy(out.extra.data(), extra.data(), extra.size());
  }
  const auto numbers =
      shaped<float>(table, {py::ssize_t(nodes), -1}, "describe() returned the table");
  out.rows = nodes;
  out.cols = std::size_t(numbers.shape(1));
  out.table.assign(numbers.data(), numbers.data() + numbers.size());
  return out;
}

std::vector<Candidate> to_candidates(const py::object& returned) {
  std::vector<Candidate> out;
  for (const py::handle& item : as_list(returned, "match() returned"))
    out.push_back(to_candidate(item));
  return out;
}

Alignment to_alignment(const py::object& returned) {
  if (!py::isinstance(returned, host().attr("Alignment")))
    throw std::runtime_error("align() returned a " + type_of(returned) + "; expected an Alignment");
  Alignment out;
  out.converged = as<bool>(py::bool_(returned.attr("converged")), "converged", "a bool");
  out.T_target_source = to_se3(returned.attr("T_target_source"), "T_target_source");
  out.information = to_mat6(returned.attr("information"), "information");
  out.reason = as<std::string>(returned.attr("reason"), "reason", "a text");
  for (const auto& [name, value] : as<py::dict>(returned.attr("scores"), "scores", "a dict"))
    out.scores.emplace_back(as<std::string>(name, "the name of a score", "a text"),
                            as<double>(value, "a score", "a number"));
  return out;
}

std::vector<std::filesystem::path> to_paths(const py::object& returned) {
  std::vector<std::filesystem::path> out;
  for (const py::handle& path : as_list(returned, "write() returned"))
    out.emplace_back(py::str(path).cast<std::string>());
  return out;
}

std::vector<Metric> to_metrics(const py::object& returned, const std::string& prefix) {
  std::vector<Metric> out;
  for (const py::handle& item : as_list(returned, "evaluate() returned")) {
    if (!py::isinstance(item, host().attr("Metric")))
      throw std::runtime_error("evaluate() returned a " + type_of(item) +
                               " in its list; expected a Metric");
    out.push_back({prefix + as<std::string>(item.attr("name"), "a metric's name", "a text"),
                   as<double>(item.attr("value"), "a metric's value", "a number"),
                   as<std::string>(item.attr("unit"), "a metric's unit", "a text"),
                   to_better(as<std::string>(item.attr("better"), "better", "a text"))});
  }
  return out;
}

}  // namespace cambium::python
