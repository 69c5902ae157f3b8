// SPDX-License-Identifier: BSD-3-Clause
// What every component must keep, so that pipelines can trust plugins that nobody here has read.
#pragma once
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "cambium/plugin.hpp"
#include "conformance/world.hpp"
#include "engine/engine.hpp"

namespace cambium::conformance {

/// A law that does not hold: what was found, and what was expected.
class Broken : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The law says nothing about this component; why.
class NotApplicable : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

inline void require(bool holds, const std::string& what) {
  if (!holds) throw Broken(what);
}

/// The component under test with its default parameters, and what its laws need.
struct Subject {
  const Registered& registered;
  const Registry& registry;  ///< of all plugins: an exporter's output is read by the readers in it
  std::shared_ptr<Component> component;
  const World& world;

  template <class T>
  const T& as() const {
    return dynamic_cast<const T&>(*component);
  }
};

/// One use of the component, as the engine would make it. Returns the bytes of the result, so that
/// two results can be compared; throws Broken when the result is malformed.
using Call = std::function<std::string(const Context&)>;

struct Law {
  std::string name;
  std::function<void(const Subject&)> check;  ///< throws Broken or NotApplicable
};

/// What the laws of a kind consist of: how it is used, odd inputs, and laws of its own.
struct Exercise {
  Call usual;
  std::vector<std::pair<std::string, Call>> odd;  ///< what is odd about the input
  std::vector<Law> own;
};

Exercise exercise_reader(const Subject& subject);
Exercise exercise_filter(const Subject& subject);
Exercise exercise_recognizer(const Subject& subject);
Exercise exercise_registration(const Subject& subject);
Exercise exercise_verifier(const Subject& subject);
Exercise exercise_solver(const Subject& subject);
Exercise exercise_aligner(const Subject& subject);
Exercise exercise_exporter(const Subject& subject);
Exercise exercise_evaluator(const Subject& subject);
Exercise exercise(const Subject& subject);

std::vector<Law> parameter_laws();
/// Laws of any use: bytes, threads, cancellation, odd inputs.
std::vector<Law> call_laws(const Exercise& exercise);

/// A host of components with its own number of threads.
class Host {
 public:
  explicit Host(int threads);
  std::unique_ptr<Context> context(std::uint64_t seed = 1) const;
  void cancel() { cancelled_ = true; }

 private:
  std::atomic<bool> cancelled_{false};
  Progress progress_;
  Engine engine_;
};

}  // namespace cambium::conformance
