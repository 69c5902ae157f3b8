// SPDX-License-Identifier: BSD-3-Clause
#include <tbb/global_control.h>

#include <exception>

#include "engine/parallel.hpp"
#include "support/support.hpp"

namespace cambium::testing {
namespace {

class QuietContext final : public Context {
 public:
  QuietContext(int threads, std::uint64_t seed)
      : threads_(threads),
        seed_(seed),
        allowed_(tbb::global_control::max_allowed_parallelism, std::size_t(threads)),
        arena_(threads) {}

  void log(LogLevel, std::string_view) const override {}
  bool cancelled() const override { return false; }
  int threads() const override { return threads_; }
  std::uint64_t seed() const override { return seed_; }
  std::filesystem::path scratch() const override { return folder_.path(); }

  // Every body runs, whatever others throw: then the exception of the lowest i is always known.
  void parallel_for(std::size_t count,
                    const std::function<void(std::size_t)>& body) const override {
    std::vector<std::exception_ptr> thrown(count);
    const auto guarded = [&](std::size_t i) {
      try {
        body(i);
      } catch (...) {
        thrown[i] = std::current_exception();
      }
    };
    in_parallel(arena_, count, guarded);
    for (const auto& exception : thrown)
      if (exception) std::rethrow_exception(exception);
  }

 private:
  int threads_;
  std::uint64_t seed_;
  TemporaryFolder folder_;
  tbb::global_control allowed_;  // also more threads than cores: tests look for races
  mutable tbb::task_arena arena_;
};

}  // namespace

std::unique_ptr<Context> make_context(int threads, std::uint64_t seed) {
  return std::make_unique<QuietContext>(threads, seed);
}

}  // namespace cambium::testing
