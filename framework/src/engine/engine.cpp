// SPDX-License-Identifier: BSD-3-Clause
#include "engine/engine.hpp"

#include <fmt/format.h>
#include <malloc.h>
#include <unistd.h>

#include <mutex>
#include <thread>

#include "engine/memory_use.hpp"
#include "engine/parallel.hpp"
#include "engine/program.hpp"

namespace cambium {
namespace {

class ItemContext final : public Context {
 public:
  ItemContext(const Engine& engine, std::uint64_t seed) : engine_(engine), seed_(seed) {}
  void log(LogLevel level, std::string_view message) const override {
    engine_.progress().log(level, message);
  }
  bool cancelled() const override { return engine_.cancelled(); }
  int threads() const override { return engine_.threads(); }
  std::uint64_t seed() const override { return seed_; }
  std::filesystem::path scratch() const override { return engine_.scratch(); }
  void parallel_for(std::size_t count,
                    const std::function<void(std::size_t)>& body) const override {
    engine_.parallel_for(count, body);
  }
  void expect(std::size_t parts) const override { engine_.progress().expect(parts); }
  void advance() const override {
    engine_.progress().advance();
    engine_.within_memory(engine_.progress().step());
  }

 private:
  const Engine& engine_;
  std::uint64_t seed_;
};

int thread_count(int wanted) {
  return wanted > 0 ? wanted : std::max(1, int(std::thread::hardware_concurrency()));
}

std::filesystem::path make_scratch() {
  const auto folder = std::filesystem::temp_directory_path() /
                      fmt::format("cambium-{}-{}", ::getpid(), std::uintptr_t(&make_scratch));
  std::filesystem::create_directories(folder);
  return folder;
}

}  // namespace

Engine::Engine(const EngineOptions& options, Progress& progress)
    : progress_(progress),
      cancelled_(options.cancelled),
      threads_(thread_count(options.threads)),
      allowed_(tbb::global_control::max_allowed_parallelism, std::size_t(threads_)),
      arena_(threads_),
      cache_(options.cache,
             [&progress](const std::string& text) { progress.log(LogLevel::warning, text); }),
      store_(std::make_shared<MemoryStore>(options.memory)),
      scratch_(make_scratch()),
      build_(program_build()) {}

Engine::~Engine() {
  std::error_code ignored;
  std::filesystem::remove_all(scratch_, ignored);
}

bool Engine::within_memory(const std::string& what) const {
  std::size_t used = resident_bytes();
  while (used > memory() && store_->bytes() > 0) {
    store_->shrink(store_->bytes() / 2);
#if defined(__GLIBC__)
    ::malloc_trim(0);  // freed memory stays with the process otherwise
#endif
    used = resident_bytes();
  }
  if (used <= memory()) return true;
  if (!warned_of_memory_.exchange(true))
    progress_.log(LogLevel::warning,
                  fmt::format("'{}' takes {} besides payloads, more than --memory {}: payloads are "
                              "not kept and work items run one at a time; allow more memory, or "
                              "fuse fewer missions at once",
                              what, shown_bytes(used), shown_bytes(memory())));
  return false;
}

void Engine::parallel_for(std::size_t count, const std::function<void(std::size_t)>& body) const {
  std::mutex mutex;
  std::exception_ptr first;
  std::size_t first_index = count;
  // Errors do not stop the others early: which error is reported must not depend on timing. Only
  // a cancelled run skips what is left.
  const auto guarded = [&](std::size_t i) {
    if (cancelled()) return;
    try {
      body(i);
    } catch (...) {
      const std::lock_guard lock(mutex);
      if (i < first_index) first_index = i, first = std::current_exception();
    }
  };
  in_parallel(arena_, count, guarded);
  if (cancelled()) throw Cancelled();
  if (first) std::rethrow_exception(first);
}

std::unique_ptr<Context> Engine::context(const Digest& item, std::uint64_t pipeline_seed) const {
  const std::uint64_t seed = Hasher().add(pipeline_seed).add(item).digest().low;
  return std::make_unique<ItemContext>(*this, seed);
}

}  // namespace cambium
