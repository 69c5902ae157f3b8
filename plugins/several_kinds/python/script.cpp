// SPDX-License-Identifier: BSD-3-Clause
#include "script.hpp"

#include <tuple>

#include "shipped.hpp"

namespace cambium::python {

Script::Script(Kind kind, const std::string& shipped) : kind_(kind), shipped_(!shipped.empty()) {
  if (shipped_) std::tie(path_, class_) = shipped_script(shipped);
}

void Script::params(ParamVisitor& v) {
  if (!shipped_) {
    v("script", path_, "The Python file; it holds a class of this kind", in_unit("script"));
    v("class", class_, "The name of the class, where the file has several of this kind");
  }
  if (path_.empty()) return;
  if (path_ != declared_path_ || class_ != declared_class_) declare();
  bool changed = false;
  for (Declared& d : declared_) {
    const auto before = d.value;
    d.visit(v);
    changed |= d.value != before;
  }
  if (changed) object_ = nullptr;
}

void Script::declare() {
  const Gil gil;
  guarded([&] {
    const py::object type = chosen();
    declared_ = declared_by(type, path_);
    type_ = keep(type);
  });
  object_ = nullptr;
  declared_path_ = path_;
  declared_class_ = class_;
}

py::object Script::chosen() const {
  if (shipped_) host().attr("_use_shipped")(shipped_folder(), shipped_digest);
  return host().attr("_choose")(path_, to_string(kind_), class_);
}

std::string Script::check_params() const {
  if (path_.empty()) return "'script' is missing; expected a Python file with a class of this kind";
  if (!type_) return {};  // params() has thrown
  const Gil gil;
  return guarded([&] {
    const py::object wrong = object().attr("check_params")();
    return wrong.is_none() ? std::string() : py::str(wrong).cast<std::string>();
  });
}

py::object Script::object() const {
  if (!type_ && !shipped_)
    throw std::runtime_error("has no script; set the parameter 'script' to a Python file");
  if (object_) return *object_;
  // Making it may let go of the lock, and another thread makes one, too: the first one counts.
  // A shipped one may be used as it is, with its defaults, before anyone asks for its parameters.
  const py::object type = type_ ? *type_ : chosen();
  const py::dict values = values_of(type_ ? declared_ : declared_by(type, path_));
  Kept made = keep(host().attr("_make")(type, values));
  if (!object_) object_ = std::move(made);
  return *object_;
}

bool Script::flag(const char* name) const {
  if (!type_) return false;
  const Gil gil;
  return guarded([&] { return bool(py::bool_(type_->attr(name))); });
}

}  // namespace cambium::python
