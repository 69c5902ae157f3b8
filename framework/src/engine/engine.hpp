// SPDX-License-Identifier: BSD-3-Clause
// What all steps share while a pipeline runs: one thread arena, the cache, the memory store, the
// progress display.
#pragma once
#include <atomic>
#include <functional>
#include <memory>

#include <tbb/task_arena.h>

#include "engine/cache.hpp"
#include "engine/codec.hpp"
#include "engine/memory_store.hpp"
#include "engine/progress.hpp"

namespace cambium {

struct EngineOptions {
  int threads = 0;                  ///< 0 = all cores
  std::size_t memory = 4ull << 30;  ///< budget for payloads [bytes]
  std::optional<std::filesystem::path> cache;
  const std::atomic<bool>* cancelled = nullptr;  ///< set by a signal handler
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

  void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body) const;

  /// A context for one work item; its seed depends on the item's key only.
  std::unique_ptr<Context> context(const Digest& item, std::uint64_t pipeline_seed) const;

  /// The cached result under `key`, or that of `compute`, which is then kept. Sets `hit`.
  template <class T>
  T cached(const Digest& key, bool& hit, const std::function<T()>& compute) const {
    if (const auto bytes = cache_.get(key)) {
      hit = true;
      return decode<T>(*bytes);
    }
    hit = false;
    T value = compute();
    cache_.put(key, encode(value));
    return value;
  }

 private:
  Progress& progress_;
  const std::atomic<bool>* cancelled_;
  int threads_;
  mutable tbb::task_arena arena_;
  Cache cache_;
  std::shared_ptr<MemoryStore> store_;
  std::filesystem::path scratch_;
  Digest build_;
};

}  // namespace cambium
