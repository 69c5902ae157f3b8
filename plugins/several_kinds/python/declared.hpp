// SPDX-License-Identifier: BSD-3-Clause
// The parameters that a script's class declares.
#pragma once
#include <string>
#include <variant>
#include <vector>

#include "cambium/params.hpp"
#include "interpreter.hpp"

namespace cambium::python {

struct Declared {
  std::string name, doc;
  Constraint constraint;
  std::variant<bool, std::int64_t, double, std::string, std::vector<double>,
               std::vector<std::string>>
      value;

  void visit(ParamVisitor& v) {
    std::visit([&](auto& member) { v(name.c_str(), member, doc.c_str(), constraint); }, value);
  }
};

/// In the order of the class, with their defaults. Under the lock.
std::vector<Declared> declared_by(const py::object& type, const std::string& script);

/// Name to value. Under the lock.
py::dict values_of(const std::vector<Declared>& declared);

}  // namespace cambium::python
