// SPDX-License-Identifier: BSD-3-Clause
#include "arguments.hpp"

#include "arrays.hpp"

namespace cambium::python {
namespace {

py::array doubles(const std::vector<double>& values) {
  return py::array_t<double>(py::ssize_t(values.size()), values.data());
}

/// The host keeps fingerprints for as long as match() runs; scripts that keep the table have a copy
/// of their own, as one copy of a mission's table is little beside comparing it.
py::array table(const Fingerprints& f) {
  const auto copy = std::make_shared<const std::vector<float>>(f.table);
  return lent(py::dtype::of<float>(), {py::ssize_t(f.rows), py::ssize_t(f.cols)},
              {py::ssize_t(f.cols * sizeof(float)), sizeof(float)}, copy->data(), copy);
}

}  // namespace

py::object to_python(const Payload& payload) { return py::cast(payload); }

py::object to_python(const Prepared& p) {
  const auto* data = static_cast<const py::object*>(p.data.get());
  return host().attr("Prepared")(py::cast(p.payload), data ? *data : py::none());
}

py::object to_python(const Fingerprints& f) {
  const py::bytes extra(reinterpret_cast<const char*>(f.extra.data()), f.extra.size());
  return host().attr("Fingerprints")(table(f), extra);
}

py::object to_python(const Pairing& p) {
  return host().attr("Pairing")(p.within_mission, p.min_path, doubles(p.query_path),
                                doubles(p.reference_path));
}

}  // namespace cambium::python
