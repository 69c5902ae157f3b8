// SPDX-License-Identifier: BSD-3-Clause
// Solvers that do what no solver should: a matrix has to go on without them.
#include <chrono>
#include <csignal>
#include <thread>

#include "cambium/plugin.hpp"

namespace {

struct Crash final : cambium::Solver {
  cambium::Solution solve(const cambium::PoseGraph&, const cambium::Context&) const override {
    std::raise(SIGSEGV);
    return {};
  }
};

// Never looks whether it was cancelled.
struct Hang final : cambium::Solver {
  cambium::Solution solve(const cambium::PoseGraph&, const cambium::Context&) const override {
    for (;;) std::this_thread::sleep_for(std::chrono::seconds(1));
  }
};

}  // namespace

CAMBIUM_PLUGIN("misbehaving", "0.1.0") {
  registry.add<Crash>("crash", "Ends the process by a segmentation fault");
  registry.add<Hang>("hang", "Never returns");
}
