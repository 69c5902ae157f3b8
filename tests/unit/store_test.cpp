// SPDX-License-Identifier: BSD-3-Clause
// The store in memory, and the form of results in it and in the cache.
#include "engine/codec.hpp"
#include "engine/memory_store.hpp"
#include "support/support.hpp"

using namespace cambium;

namespace {

Digest key(int i) { return digest_bytes(std::to_string(i)); }

}  // namespace

TEST(MemoryStore, KeepsTheBudgetAndForgetsTheLeastRecentlyUsed) {
  MemoryStore store(100);
  int made = 0;
  const auto get = [&](int i) {
    return store.get(key(i), [&] {
      ++made;
      return MemoryStore::Value{std::make_shared<const int>(i), 40};
    });
  };
  get(1), get(2), get(1);
  EXPECT_EQ(made, 2);
  get(3);  // 120 bytes: 2 goes, it was used before 1
  EXPECT_EQ(store.bytes(), 80u);
  get(1);
  EXPECT_EQ(made, 3);
  get(2);
  EXPECT_EQ(made, 4);
  EXPECT_LE(store.bytes(), 100u);
}

TEST(MemoryStore, ServesWhatIsLargerThanTheBudget) {
  MemoryStore store(10);
  const auto value = store.get(key(1), [] {
    return MemoryStore::Value{std::make_shared<const int>(7), 1000};
  });
  EXPECT_EQ(*std::static_pointer_cast<const int>(value), 7);
}

// A value that waits for another thread as it goes, while that thread waits for the store.
TEST(MemoryStore, WhatIsForgottenGoesWhenTheStoreIsFree) {
  MemoryStore store(100);
  std::size_t asked = 0;
  const auto get = [&](int i) {
    store.get(key(i), [&] {
      return MemoryStore::Value{{new int(i), [&](int* p) { delete p, asked += 1 + store.bytes(); }},
                                60};
    });
  };
  get(1), get(2);
  EXPECT_EQ(asked, 61u);
  store.shrink(0);
  EXPECT_EQ(asked, 62u);
}

TEST(Codec, EveryResultReadsBack) {
  Alignment a;
  a.converged = true;
  a.T_target_source = SE3::from_yaw(0.3, {1, 2, 3});
  a.information = Mat6::Identity() * 7;
  a.scores = {{"overlap", 0.5}, {"rmse", 0.04}};
  a.reason = "none";
  EXPECT_EQ(encode(decode<Alignment>(encode(a))), encode(a));
  Candidate c{3, 4, 0.5, SE3::from_yaw(1)};
  const auto list = decode<std::vector<Candidate>>(encode(std::vector<Candidate>{c, {}}));
  EXPECT_EQ(list[0].T_reference_query->q.coeffs(), c.T_reference_query->q.coeffs());
  EXPECT_FALSE(list[1].T_reference_query);
  Fingerprints f{2, 3, {1, 2, 3, 4, 5, 6}, {std::byte{9}}};
  EXPECT_EQ(encode(decode<Fingerprints>(encode(f))), encode(f));
}

TEST(Codec, RefusesWhatEndsEarly) {
  const std::string bytes = encode(std::vector<Candidate>(3));
  for (std::size_t n = 0; n < bytes.size(); ++n)
    EXPECT_THROW(decode<std::vector<Candidate>>(bytes.substr(0, n)), Error) << n;
}

TEST(MemoryStore, ShrinksWhenTheProcessNeedsTheMemory) {
  MemoryStore store(1000);
  for (int i = 0; i < 5; ++i)
    store.get(key(i), [&] { return MemoryStore::Value{std::make_shared<const int>(i), 100}; });
  store.shrink(250);
  EXPECT_EQ(store.bytes(), 200u);
  store.shrink(0);
  EXPECT_EQ(store.bytes(), 0u);
}
