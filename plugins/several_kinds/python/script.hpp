// SPDX-License-Identifier: BSD-3-Clause
// A class of a script as a component: its parameters, its object, calls of its methods.
#pragma once
#include <new>
#include <string>

#include "arguments.hpp"
#include "declared.hpp"

namespace cambium::python {

class Script {
 public:
  /// `shipped`: "file.py:Class" of one that comes with this library, in place of the parameters
  /// `script` and `class`.
  explicit Script(Kind kind, const std::string& shipped = {});

  /// `script`, `class`, and what the class declares.
  void params(ParamVisitor& v);
  /// Makes the object, so that a script that cannot work says so before anything runs.
  std::string check_params() const;

  const std::string& path() const { return path_; }
  /// The object with its parameters, made when it is wanted. Under the lock.
  py::object object() const;
  /// A bool that the class may set, such as `uses_poses`; false without a script.
  bool flag(const char* name) const;

  /// f(script's object, Call) under the lock. What the script throws becomes an Error.
  template <class F>
  auto call(const Context& context, F&& f) const {
    const Gil gil;
    const auto loan = std::make_shared<Loan>();
    const Speaking speaking(context);
    struct End {
      Loan& loan;
      ~End() { loan.end(); }
    } const end{*loan};
    return guarded([&] { return f(object(), loan, py::cast(LentContext{loan, &context})); });
  }
  /// f() under the lock, without a context.
  template <class F>
  auto guarded(F&& f) const try {
    return f();
  } catch (py::error_already_set& e) {
    rethrow(e, path_);
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& e) {  // a result that is not what was expected
    throw Error(ErrorCode::plugin, path_, e.what());
  }

 private:
  void declare();
  py::object chosen() const;  ///< the class, under the lock

  Kind kind_;
  bool shipped_ = false;
  std::string path_, class_;
  std::string declared_path_, declared_class_;  ///< what `declared_` belongs to
  std::vector<Declared> declared_;
  Kept type_;
  mutable Kept object_;
};

}  // namespace cambium::python
