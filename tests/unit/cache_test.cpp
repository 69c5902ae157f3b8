// SPDX-License-Identifier: BSD-3-Clause
// The cache on disk: entries are whole or absent, whoever writes, damages or prunes them.
#include <fstream>
#include <thread>

#include "cambium/files.hpp"
#include "engine/cache.hpp"
#include "engine/cache_upkeep.hpp"
#include "support/support.hpp"

using namespace cambium;
using cambium::testing::TemporaryFolder;
namespace fs = std::filesystem;

namespace {

Digest key(int i) { return digest_bytes(std::to_string(i)); }

CacheEntry entry(std::string bytes) { return {"register gicp", 0.25, std::move(bytes)}; }

std::optional<std::string> get(const Cache& cache, int i) {
  const auto found = cache.get(key(i));
  return found ? std::optional(found->bytes) : std::nullopt;
}

fs::path only_file(const fs::path& folder) {
  for (const auto& e : fs::recursive_directory_iterator(folder))
    if (e.is_regular_file()) return e.path();
  return {};
}

void make_older(const fs::path& file, int hours) {
  fs::last_write_time(file, fs::file_time_type::clock::now() - std::chrono::hours(hours));
}

}  // namespace

TEST(Cache, GivesBackWhatWasPut) {
  const TemporaryFolder folder;
  const Cache cache(folder.path());
  EXPECT_FALSE(cache.get(key(1)));
  cache.put(key(1), entry(std::string("a\0b", 3)));
  const auto found = cache.get(key(1));
  ASSERT_TRUE(found);
  EXPECT_EQ(found->bytes, std::string("a\0b", 3));
  EXPECT_EQ(found->kind, "register gicp");
  EXPECT_EQ(found->seconds, 0.25);
  EXPECT_FALSE(cache.get(key(2)));
}

TEST(Cache, WithoutAFolderKeepsNothing) {
  const Cache cache(std::nullopt);
  cache.put(key(1), entry("x"));
  EXPECT_FALSE(cache.get(key(1)));
}

TEST(Cache, EveryByteOfAnEntryIsProtected) {
  const std::string packed = pack({"solve", 1.5, "result"});
  ASSERT_TRUE(unpack(packed));
  for (std::size_t i = 0; i < packed.size(); ++i) {
    std::string damaged = packed;
    damaged[i] = char(damaged[i] ^ 0x10);
    EXPECT_FALSE(unpack(damaged)) << "byte " << i;
    EXPECT_FALSE(unpack(packed.substr(0, i))) << "cut at " << i;
    EXPECT_NO_THROW(unpack_head(damaged.substr(0, i)));
  }
}

TEST(Cache, DamagedEntriesAreAbsentAndTold) {
  const TemporaryFolder folder;
  std::vector<std::string> warnings;
  const Cache cache(folder.path(), [&](const std::string& text) { warnings.push_back(text); });
  cache.put(key(1), entry(std::string(1000, 'x')));
  std::fstream file(only_file(folder.path()), std::ios::in | std::ios::out | std::ios::binary);
  file.seekp(600).put('y');
  file.close();
  EXPECT_FALSE(cache.get(key(1)));
  EXPECT_TRUE(only_file(folder.path()).empty());  // gone, so that it is written again
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("does not fit its digest"), std::string::npos) << warnings[0];
  EXPECT_FALSE(cache.get(key(1)));
  EXPECT_EQ(warnings.size(), 1u);  // an absent entry is no damage
}

TEST(Cache, ManyWritersOfOneKeyLeaveOneWholeEntry) {
  const TemporaryFolder folder;
  const Cache cache(folder.path());
  const std::string content(100000, 'z');
  std::vector<std::thread> writers;
  for (int t = 0; t < 4; ++t)
    writers.emplace_back([&] {
      for (int i = 0; i < 20; ++i) {
        cache.put(key(1), entry(content));
        const auto got = get(cache, 1);
        if (got) {
          EXPECT_EQ(*got, content);
        }
      }
    });
  for (auto& w : writers) w.join();
  EXPECT_EQ(get(cache, 1), content);
}

TEST(CacheUpkeep, GroupsByWhatMadeTheEntries) {
  const TemporaryFolder folder;
  const Cache cache(folder.path());
  cache.put(key(1), {"register gicp", 2, "x"});
  cache.put(key(2), {"register gicp", 3, "yy"});
  cache.put(key(3), {"optimize ceres", 1, "z"});
  fs::create_directories(folder / "notes");
  write_file(folder / "notes/README", "not an entry");
  const auto groups = cache_by_kind(folder.path());
  ASSERT_EQ(groups.size(), 2u);
  EXPECT_EQ(groups.at("register gicp").entries, 2u);
  EXPECT_EQ(groups.at("register gicp").seconds, 5);
  EXPECT_EQ(groups.at("optimize ceres").entries, 1u);
}

TEST(CacheUpkeep, VerifyRemovesWhatDoesNotFitItsDigest) {
  const TemporaryFolder folder;
  const Cache cache(folder.path());
  cache.put(key(1), entry("good"));
  EXPECT_TRUE(remove_damaged(folder.path()).empty());
  const fs::path good = only_file(folder.path());
  cache.put(key(2), entry("cut"));
  for (const auto& e : fs::recursive_directory_iterator(folder.path()))
    if (e.is_regular_file() && e.path() != good) fs::resize_file(e.path(), 30);
  EXPECT_EQ(remove_damaged(folder.path()).size(), 1u);
  EXPECT_TRUE(remove_damaged(folder.path()).empty());
  EXPECT_EQ(get(cache, 1), "good");
}

TEST(CacheUpkeep, PruneRemovesTheLongestUnusedFirst) {
  const TemporaryFolder folder;
  const Cache cache(folder.path());
  std::vector<fs::path> files;
  for (int i = 0; i < 4; ++i) {
    cache.put(key(i), entry(std::string(100, 'x')));
    files.push_back(folder.path() / key(i).hex().substr(0, 2) / key(i).hex().substr(2));
    make_older(files.back(), 100 - 20 * i);
  }
  get(cache, 0);  // a hit counts as a use
  Pruned p = prune_cache(folder.path(), {2 * fs::file_size(files[0]), {}});
  EXPECT_EQ(p.removed, 2u);
  EXPECT_TRUE(get(cache, 0));
  EXPECT_FALSE(get(cache, 1));
  EXPECT_FALSE(get(cache, 2));
  make_older(files[3], 30);
  p = prune_cache(folder.path(), {{}, std::chrono::hours(24)});
  EXPECT_EQ(p.removed, 1u);
  EXPECT_FALSE(get(cache, 3));
  EXPECT_EQ(p.kept, 1u);
}

TEST(CacheUpkeep, PruneSweepsWhatKilledWritersLeft) {
  const TemporaryFolder folder;
  fs::create_directories(folder / "ab");
  for (const char* name : {".tmp-1-0-old", ".tmp-1-1-new"}) write_file(folder / "ab" / name, "x");
  make_older(folder / "ab/.tmp-1-0-old", 2);
  prune_cache(folder.path(), {{}, std::chrono::hours(1)});
  EXPECT_FALSE(fs::exists(folder / "ab/.tmp-1-0-old"));
  EXPECT_TRUE(fs::exists(folder / "ab/.tmp-1-1-new"));  // may be in the making
}
