// SPDX-License-Identifier: BSD-3-Clause
// What all steps share while a pipeline runs: one thread arena, the cache, the memory store, the
// progress display.
#pragma once
#include <atomic>
#include <chrono>
#include <functional>
#include <memory>

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include "engine/cache.hpp"
#include "engine/codec.hpp"
#include "engine/memory_store.hpp"
#include "engine/progress.hpp"

namespace cambium {

struct EngineOptions {
  int threads = 0;                  ///< 0 = all cores
  std::size_t memory = 4ull << 30;  ///< budget for the whole process [bytes]
  std::optional<std::filesystem::path> cache;
  const std::atomic<bool>* cancelled = nullptr;  ///< set by a signal handler
};

/// How a result came about.
struct Making {
  bool hit = false;    ///< it came from the cache
  double seconds = 0;  ///< what making it took, now or when it was made
};

class Engine {
 public:
  Engine(const EngineOptions& options, Progress& progress);
  ~Engine();

  int threads() const { return threads_; }
  bool cancelled() const { return cancelled_ && cancelled_->load(); }
  Progress& progress() const { return progress_; }
  const std::shared_ptr<MemoryStore>& store() const { return store_; }
  const std::filesystem::path& scratch() const { return scratch_; }

  /// Of the program itself: another build never meets this one's results in the cache.
  const Digest& build() const { return build_; }

  /// Whether the process is within its memory budget. What the store keeps for later goes first;
  /// where that is not enough, a warning names `what` runs, once, and the answer is no.
  bool within_memory(const std::string& what) const;
  std::size_t memory() const { return store_->budget(); }

  void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body) const;

  /// A context for one work item; its seed depends on the item's key only.
  std::unique_ptr<Context> context(const Digest& item, std::uint64_t pipeline_seed) const;

  /// The cached result under `key`, or that of `compute`, which is then kept under `kind`.
  template <class T>
  T cached(const Digest& key, const std::string& kind, Making& making,
           const std::function<T()>& compute) const {
    if (const auto entry = cache_.get(key)) {
      making = {true, entry->seconds};
      return decode<T>(entry->bytes);
    }
    const auto begin = std::chrono::steady_clock::now();
    T value = compute();
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
    making = {false, spent.count()};
    cache_.put(key, {kind, spent.count(), encode(value)});
    return value;
  }

 private:
  Progress& progress_;
  const std::atomic<bool>* cancelled_;
  int threads_;
  tbb::global_control allowed_;  ///< TBB has as many threads as cores, whatever an arena asks for
  mutable tbb::task_arena arena_;
  Cache cache_;
  std::shared_ptr<MemoryStore> store_;
  std::filesystem::path scratch_;
  Digest build_;
  mutable std::atomic<bool> warned_of_memory_{false};
};

}  // namespace cambium
