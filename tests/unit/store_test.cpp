// SPDX-License-Identifier: BSD-3-Clause
// The cache on disk, the store in memory, and the form of results in both.
#include <fstream>
#include <thread>

#include "cambium/files.hpp"
#include "engine/cache.hpp"
#include "engine/codec.hpp"
#include "engine/memory_store.hpp"
#include "support/support.hpp"

using namespace cambium;
namespace fs = std::filesystem;

namespace {

Digest key(int i) { return digest_bytes(std::to_string(i)); }

fs::path only_file(const fs::path& folder) {
  for (const auto& e : fs::recursive_directory_iterator(folder))
    if (e.is_regular_file()) return e.path();
  return {};
}

}  // namespace

TEST(Cache, GivesBackWhatWasPut) {
  const cambium::testing::TemporaryFolder folder;
  const Cache cache(folder.path());
  EXPECT_FALSE(cache.get(key(1)));
  cache.put(key(1), std::string("a\0b", 3));
  EXPECT_EQ(cache.get(key(1)), std::string("a\0b", 3));
  EXPECT_FALSE(cache.get(key(2)));
}

TEST(Cache, WithoutAFolderKeepsNothing) {
  const Cache cache(std::nullopt);
  cache.put(key(1), "x");
  EXPECT_FALSE(cache.get(key(1)));
}

TEST(Cache, DamagedEntriesAreAbsent) {
  const cambium::testing::TemporaryFolder folder;
  const Cache cache(folder.path());
  const std::string content(1000, 'x');
  for (const std::size_t keep :
       {std::size_t{0}, std::size_t{7}, std::size_t{23}, std::size_t{500}}) {
    cache.put(key(1), content);
    fs::resize_file(only_file(folder.path()), keep);
    EXPECT_FALSE(cache.get(key(1))) << keep;
  }
  cache.put(key(1), content);
  std::fstream file(only_file(folder.path()), std::ios::in | std::ios::out | std::ios::binary);
  file.seekp(600).put('y');
  file.close();
  EXPECT_FALSE(cache.get(key(1)));
  EXPECT_TRUE(only_file(folder.path()).empty());  // gone, so that it is written again
}

TEST(Cache, ManyWritersOfOneKeyLeaveOneWholeEntry) {
  const cambium::testing::TemporaryFolder folder;
  const Cache cache(folder.path());
  const std::string content(100000, 'z');
  std::vector<std::thread> writers;
  for (int t = 0; t < 4; ++t)
    writers.emplace_back([&] {
      for (int i = 0; i < 20; ++i) {
        cache.put(key(1), content);
        const auto got = cache.get(key(1));
        if (got) EXPECT_EQ(*got, content);
      }
    });
  for (auto& w : writers) w.join();
  EXPECT_EQ(cache.get(key(1)), content);
}

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
