// SPDX-License-Identifier: BSD-3-Clause
// Python in this process: started once, by whoever needs it first, and never ended (components and
// exceptions may live as long as the process).
#pragma once
#include <pybind11/pybind11.h>

#include <memory>

#include "cambium/context.hpp"
#include "cambium/error.hpp"

namespace cambium::python {

namespace py = pybind11;

extern const char* const prelude;  ///< cambium.py

/// Holds the interpreter's lock, and starts the interpreter if nobody has. Throws Error(plugin)
/// when it does not start. Whatever waits for other threads must release the lock first.
class Gil {
 public:
  Gil() : started_((start(), true)) {}

 private:
  static void start();
  [[maybe_unused]] bool started_;
  py::gil_scoped_acquire gil_;
};

/// The module `cambium`, as scripts see it. Under the lock.
py::module_ host();

/// An object that threads without the lock may copy and let go of.
using Kept = std::shared_ptr<py::object>;
Kept keep(py::object object);

/// While it lives, what Python prints on this thread goes to the log of a context.
class Speaking {
 public:
  explicit Speaking(const Context& context);
  ~Speaking();
  Speaking(const Speaking&) = delete;
  Speaking& operator=(const Speaking&) = delete;

 private:
  const Context* before_;
};
/// A line that Python printed. Those printed while no call is under way wait for the next one.
void say(const std::string& line);

/// The exception of a script as an Error: cambium.Error as it is, cambium.Cancelled as Cancelled,
/// any other as Error(plugin) with the script's line and the traceback. Under the lock.
[[noreturn]] void rethrow(py::error_already_set& e, const std::string& script);
/// Makes cambium.Error and cambium.Cancelled of what the host throws into Python.
void translate_exceptions();

}  // namespace cambium::python
