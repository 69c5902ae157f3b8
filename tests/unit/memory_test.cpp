// SPDX-License-Identifier: BSD-3-Clause
// What `--memory` does.
#include "engine/engine.hpp"
#include "engine/memory_use.hpp"
#include "support/support.hpp"

using namespace cambium;

TEST(Memory, TheSystemSaysWhatTheProcessTakes) {
  EXPECT_GT(resident_bytes(), std::size_t(1) << 20);
  EXPECT_GE(peak_bytes(), resident_bytes() / 2);
  EXPECT_EQ(shown_bytes(512 << 20), "512M");
  EXPECT_EQ(shown_bytes(std::size_t(3277) << 20), "3.2G");
}

TEST(Memory, BeyondTheBudgetPayloadsGoAndOneWarningNamesTheStep) {
  Progress progress(Progress::Style::quiet, LogLevel::error);
  EngineOptions options;
  options.memory = std::size_t(1) << 20;  // less than any process takes
  const Engine engine(options, progress);
  engine.store()->get(digest_bytes("a"), [] {
    return MemoryStore::Value{std::make_shared<const int>(1), 1000};
  });
  EXPECT_EQ(engine.store()->bytes(), 1000u);
  EXPECT_FALSE(engine.within_memory("register gicp"));
  EXPECT_FALSE(engine.within_memory("register gicp"));
  EXPECT_EQ(engine.store()->bytes(), 0u);
  ASSERT_EQ(progress.warnings().size(), 1u);
  EXPECT_NE(progress.warnings()[0].find("'register gicp' takes"), std::string::npos);
  EXPECT_NE(progress.warnings()[0].find("more than --memory 1M"), std::string::npos);
}

TEST(Memory, WithinTheBudgetNothingIsForgotten) {
  Progress progress(Progress::Style::quiet, LogLevel::error);
  const Engine engine(EngineOptions{}, progress);
  engine.store()->get(digest_bytes("a"), [] {
    return MemoryStore::Value{std::make_shared<const int>(1), 1000};
  });
  EXPECT_TRUE(engine.within_memory("register gicp"));
  EXPECT_EQ(engine.store()->bytes(), 1000u);
  EXPECT_TRUE(progress.warnings().empty());
}
