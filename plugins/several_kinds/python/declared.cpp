// SPDX-License-Identifier: BSD-3-Clause
#include "declared.hpp"

#include <pybind11/stl.h>

namespace cambium::python {
namespace {

Constraint to_constraint(const py::handle& c) {
  Constraint out;
  out.low = c.attr("low").cast<double>();
  out.high = c.attr("high").cast<double>();
  out.low_open = c.attr("low_open").cast<bool>();
  out.high_open = c.attr("high_open").cast<bool>();
  out.choices = c.attr("choices").cast<std::vector<std::string>>();
  out.unit = c.attr("unit").cast<std::string>();
  return out;
}

}  // namespace

std::vector<Declared> declared_by(const py::object& type, const std::string& script) {
  std::vector<Declared> out;
  for (const py::handle& item : host().attr("_declared")(type, script)) {
    const py::tuple pair = item.cast<py::tuple>();
    const py::object param = pair[1], value = param.attr("default");
    const auto kind = param.attr("type").cast<std::string>();
    Declared d{pair[0].cast<std::string>(), param.attr("doc").cast<std::string>(),
               to_constraint(param.attr("constraint")), false};
    if (kind == "bool") d.value = value.cast<bool>();
    if (kind == "int") d.value = value.cast<std::int64_t>();
    if (kind == "float") d.value = value.cast<double>();
    if (kind == "str") d.value = value.cast<std::string>();
    if (kind == "numbers") d.value = value.cast<std::vector<double>>();
    if (kind == "texts") d.value = value.cast<std::vector<std::string>>();
    out.push_back(std::move(d));
  }
  return out;
}

py::dict values_of(const std::vector<Declared>& declared) {
  py::dict out;
  for (const Declared& d : declared)
    out[d.name.c_str()] =
        std::visit([](const auto& value) { return py::object(py::cast(value)); }, d.value);
  return out;
}

}  // namespace cambium::python
