// SPDX-License-Identifier: BSD-3-Clause
// Made-up components that take everything as it comes, for tests of the engine around them.
#pragma once
#include "cambium/plugin.hpp"

namespace cambium::testing {

/// Every guess is right.
struct TrustGuess final : Registration {
  Alignment align(const Prepared&, const Prepared&, const SE3& guess,
                  const Context&) const override {
    Alignment a;
    a.converged = true;
    a.T_target_source = guess;
    return a;
  }
};

struct AcceptAll final : LoopVerifier {
  std::vector<Verdict> verify(const Atlas&, std::span<const std::size_t> loops,
                              const Context&) const override {
    return std::vector<Verdict>(loops.size(), {true, "everything is accepted"});
  }
};

}  // namespace cambium::testing
