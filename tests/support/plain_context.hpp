// SPDX-License-Identifier: BSD-3-Clause
// A context of one thread that hears nothing and is never cancelled: what a test overrides.
#pragma once
#include "cambium/context.hpp"

namespace cambium::testing {

class PlainContext : public Context {
 public:
  void log(LogLevel, std::string_view) const override {}
  bool cancelled() const override { return false; }
  int threads() const override { return 1; }
  std::uint64_t seed() const override { return 1; }
  std::filesystem::path scratch() const override { return {}; }
  void parallel_for(std::size_t n, const std::function<void(std::size_t)>& body) const override {
    for (std::size_t i = 0; i < n; ++i) body(i);
  }
};

/// Counts the parts that an exporter speaks of.
class CountingContext : public PlainContext {
 public:
  void expect(std::size_t parts) const override { expected += parts; }
  void advance() const override { ++done; }
  mutable std::size_t expected = 0, done = 0;
};

}  // namespace cambium::testing
