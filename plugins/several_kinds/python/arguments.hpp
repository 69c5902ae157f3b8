// SPDX-License-Identifier: BSD-3-Clause
// What a call lends to a script. The host's objects end with the call; a script that keeps what it
// was lent gets an error, not memory of others.
#pragma once
#include <atomic>

#include "cambium/kinds.hpp"
#include "interpreter.hpp"

namespace cambium::python {

class Loan {
 public:
  void end() { over_ = true; }
  void check() const {
    if (over_)
      throw std::runtime_error("is only there during the call that it was passed to; keep arrays");
  }

 private:
  std::atomic<bool> over_{false};
};
using SharedLoan = std::shared_ptr<const Loan>;

struct LentContext {
  SharedLoan loan;
  const Context* context;
  const Context& get() const { return loan->check(), *context; }
};

struct LentAtlas {
  SharedLoan loan;
  const Atlas* atlas;
  const Atlas& get() const { return loan->check(), *atlas; }
};

struct LentMission {
  LentAtlas atlas;
  std::uint32_t index;
  MissionView get() const { return {atlas.get(), index}; }
};

/// The classes of module `_cambium`, registered when Python starts.
void bind_payloads(py::module_& m);
void bind_atlas(py::module_& m);

/// As Python objects, under the lock.
py::object to_python(const Payload& payload);
py::object to_python(const Prepared& prepared);
py::object to_python(const Fingerprints& fingerprints);
py::object to_python(const Pairing& pairing);

}  // namespace cambium::python
