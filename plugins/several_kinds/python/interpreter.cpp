// SPDX-License-Identifier: BSD-3-Clause
#include "interpreter.hpp"

#include <dlfcn.h>
#include <pybind11/numpy.h>

#include <cstdlib>
#include <filesystem>
#include <mutex>
#include <vector>

namespace cambium::python {
namespace {

// Extension modules such as NumPy's look for the interpreter among the symbols of the whole
// process, but plugins are opened with RTLD_LOCAL.
void show_interpreter_to_extensions() {
  Dl_info library{};
  dladdr(reinterpret_cast<const void*>(&Py_InitializeFromConfig), &library);
  if (!dlopen(library.dli_fname, RTLD_NOW | RTLD_GLOBAL | RTLD_NOLOAD))
    throw Error(
        ErrorCode::plugin, library.dli_fname ? library.dli_fname : "libpython",
        "cannot be opened for all of the process; is python3-dev installed as it was built?");
}

// An active virtual environment brings its packages (onnxruntime, torch) with it.
std::string program() {
  const char* environment = std::getenv("VIRTUAL_ENV");
  const auto of_environment = std::filesystem::path(environment ? environment : "") / "bin/python3";
  return environment && std::filesystem::exists(of_environment) ? of_environment.string()
                                                                : CAMBIUM_PYTHON;
}

void check(const PyStatus& status) {
  if (PyStatus_Exception(status))
    throw Error(ErrorCode::plugin, program(),
                std::string("Python does not start: ") + (status.err_msg ? status.err_msg : "?"));
}

// The host keeps its signals, its locale and its folders (no __pycache__); sets of texts are
// iterated in the same order every time.
void initialize() {
  PyPreConfig before;
  PyPreConfig_InitPythonConfig(&before);
  before.utf8_mode = 1;
  before.configure_locale = before.coerce_c_locale = 0;
  check(Py_PreInitialize(&before));
  PyConfig config;
  PyConfig_InitPythonConfig(&config);
  config.install_signal_handlers = config.write_bytecode = config.parse_argv = 0;
  config.use_hash_seed = 1;
  config.hash_seed = 0;
  const PyStatus named = PyConfig_SetBytesString(&config, &config.program_name, program().c_str());
  const PyStatus done = PyStatus_Exception(named) ? named : Py_InitializeFromConfig(&config);
  PyConfig_Clear(&config);
  check(done);
}

// pybind11 looks NumPy's functions up in a static variable, at the first array. The lookup may let
// go of the lock; a thread that then takes it waits for the variable, and all wait for that thread.
// So the first array is made while there is one thread.
void use_arrays() { py::dtype::of<double>(); }

void import_prelude() try {
  py::module_ module = py::reinterpret_steal<py::module_>(PyModule_New("cambium"));
  py::module_::import("sys").attr("modules")["cambium"] = module;
  const py::object code =
      py::module_::import("builtins").attr("compile")(prelude, "<cambium>", "exec");
  py::module_::import("builtins").attr("exec")(code, module.attr("__dict__"));
  translate_exceptions();
  use_arrays();
} catch (py::error_already_set& e) {
  throw Error(ErrorCode::plugin, program(),
              std::string("Python starts, but not with NumPy: ") + e.what());
}

}  // namespace

void Gil::start() {
  static std::once_flag once;
  std::call_once(once, [] {
    // Libraries that add up with as many threads as there are cores do not give the same bytes
    // everywhere; the host has its own threads.
    for (const char* variable : {"OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"})
      setenv(variable, "1", 0);
    show_interpreter_to_extensions();
    initialize();
    import_prelude();
    PyEval_SaveThread();  // from here on any thread may take the lock
  });
}

py::module_ host() { return py::module_::import("cambium"); }

Kept keep(py::object object) {
  return {new py::object(std::move(object)), [](py::object* p) {
            const Gil gil;
            delete p;
          }};
}

namespace {

thread_local const Context* listening = nullptr;
std::mutex mutex;
std::vector<std::string>& waiting() {
  static std::vector<std::string> lines;
  return lines;
}

}  // namespace

Speaking::Speaking(const Context& context) : before_(listening) {
  listening = &context;
  std::vector<std::string> lines;
  {
    const std::lock_guard lock(mutex);
    lines.swap(waiting());
  }
  const py::gil_scoped_release unlocked;
  for (const std::string& line : lines) context.info(line);
}

Speaking::~Speaking() { listening = before_; }

void say(const std::string& line) {
  const py::gil_scoped_release unlocked;
  if (listening) return listening->info(line);
  const std::lock_guard lock(mutex);
  if (waiting().size() < 1000) waiting().push_back(line);
}

void rethrow(py::error_already_set& e, const std::string& script) {
  const py::module_ module = host();
  if (e.matches(module.attr("Cancelled"))) throw Cancelled();
  if (e.matches(module.attr("Error"))) {
    const auto where = e.value().attr("where").cast<std::string>();
    throw Error(ErrorCode(e.value().attr("code").cast<int>()), where.empty() ? script : where,
                e.value().attr("what").cast<std::string>());
  }
  py::object value = e.value();
  if (e.trace()) PyException_SetTraceback(value.ptr(), e.trace().ptr());
  const auto [where, what] =
      module.attr("_explain")(value, script).cast<std::pair<std::string, std::string>>();
  throw Error(ErrorCode::plugin, where, what);
}

void translate_exceptions() {
  py::register_exception_translator([](std::exception_ptr p) {
    try {
      if (p) std::rethrow_exception(p);
    } catch (const Cancelled&) {
      PyErr_SetNone(host().attr("Cancelled").ptr());
    } catch (const Error& e) {
      const py::object type = host().attr("Error");
      PyErr_SetObject(type.ptr(), type(e.message(), e.where(), int(e.code())).ptr());
    }
  });
}

}  // namespace cambium::python
