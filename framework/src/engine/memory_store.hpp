// SPDX-License-Identifier: BSD-3-Clause
// Payloads and what is computed from them, kept in memory up to a budget (least recently used goes
// first). This is what lets an atlas be larger than RAM.
#pragma once
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include "cambium/payload.hpp"

namespace cambium {

class MemoryStore {
 public:
  struct Value {
    std::shared_ptr<const void> data;
    std::size_t bytes = 0;
  };

  explicit MemoryStore(std::size_t budget_bytes) : budget_(budget_bytes) {}

  /// The value under `key`, made by `make` when it is not there. Two threads that miss at the same
  /// time both make it: waiting for each other inside a task pool can deadlock.
  std::shared_ptr<const void> get(const Digest& key, const std::function<Value()>& make);

  /// Forgets what was not used lately until at most so many bytes are kept.
  void shrink(std::size_t bytes);

  std::size_t bytes() const;
  std::size_t budget() const { return budget_; }

 private:
  struct Entry {
    Value value;
    std::list<Digest>::iterator used;
  };
  /// Destroy what comes back when the lock is free: a value may wait for others as it goes (that of
  /// a Python registration waits for the interpreter).
  [[nodiscard]] std::vector<Value> evict(std::size_t limit, std::size_t keep);

  const std::size_t budget_;
  mutable std::mutex mutex_;
  std::map<Digest, Entry> entries_;
  std::list<Digest> recent_;  // front = used last
  std::size_t bytes_ = 0;
};

/// `source`, loaded through the store.
std::shared_ptr<const PayloadSource> stored(std::shared_ptr<const PayloadSource> source,
                                            std::shared_ptr<MemoryStore> store);

}  // namespace cambium
