// SPDX-License-Identifier: BSD-3-Clause
#include "engine/memory_store.hpp"

namespace cambium {
namespace {

class StoredSource final : public PayloadSource {
 public:
  StoredSource(std::shared_ptr<const PayloadSource> inner, std::shared_ptr<MemoryStore> store)
      : inner_(std::move(inner)), store_(std::move(store)) {}

  Payload load() const override {
    const auto value = store_->get(digest(), [this] {
      auto payload = std::make_shared<const Payload>(inner_->load());
      const std::size_t bytes = payload->bytes();
      return MemoryStore::Value{payload, bytes};
    });
    return *std::static_pointer_cast<const Payload>(value);
  }
  Digest digest() const override { return inner_->digest(); }
  std::string where() const override { return inner_->where(); }

 private:
  std::shared_ptr<const PayloadSource> inner_;
  std::shared_ptr<MemoryStore> store_;
};

}  // namespace

std::shared_ptr<const void> MemoryStore::get(const Digest& key,
                                             const std::function<Value()>& make) {
  {
    const std::lock_guard lock(mutex_);
    const auto it = entries_.find(key);
    if (it != entries_.end()) {
      recent_.splice(recent_.begin(), recent_, it->second.used);
      return it->second.value.data;
    }
  }
  Value value = make();
  std::vector<Value> evicted;
  const std::lock_guard lock(mutex_);
  const auto [it, fresh] = entries_.try_emplace(key);
  if (!fresh) return it->second.value.data;  // another thread was first: keep one copy
  recent_.push_front(key);
  it->second = {value, recent_.begin()};
  bytes_ += value.bytes;
  // The newest entry stays even when it alone is over the budget: its user holds it anyway.
  evicted = evict(budget_, 1);
  return value.data;
}

void MemoryStore::shrink(std::size_t bytes) {
  std::vector<Value> evicted;
  const std::lock_guard lock(mutex_);
  evicted = evict(bytes, 0);
}

std::vector<MemoryStore::Value> MemoryStore::evict(std::size_t limit, std::size_t keep) {
  std::vector<Value> out;
  while (bytes_ > limit && recent_.size() > keep) {
    const auto it = entries_.find(recent_.back());
    bytes_ -= it->second.value.bytes;
    out.push_back(std::move(it->second.value));
    entries_.erase(it);
    recent_.pop_back();
  }
  return out;
}

std::size_t MemoryStore::bytes() const {
  const std::lock_guard lock(mutex_);
  return bytes_;
}

std::shared_ptr<const PayloadSource> stored(std::shared_ptr<const PayloadSource> source,
                                            std::shared_ptr<MemoryStore> store) {
  if (!source) return nullptr;
  return std::make_shared<StoredSource>(std::move(source), std::move(store));
}

}  // namespace cambium
