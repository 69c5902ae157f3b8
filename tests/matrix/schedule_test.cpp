// SPDX-License-Identifier: BSD-3-Clause
#include "matrix/schedule.hpp"

#include <gtest/gtest.h>

namespace cambium::matrix {
namespace {

using Jobs = std::vector<std::size_t>;

TEST(Schedule, JobsThatShareNothingRunSideBySide) {
  Schedule s({{"a"}, {"b"}, {"c"}});
  EXPECT_EQ(s.ready(2), (Jobs{0, 1}));
  s.start(0);
  EXPECT_EQ(s.ready(5), (Jobs{1, 2}));
}

TEST(Schedule, OneGoesAheadForThoseThatBeginAlike) {
  Schedule s({{"recognize", "gicp", "ceres"}, {"recognize", "gicp", "g2o"}, {"recognize", "ndt"}});
  EXPECT_EQ(s.ready(3), (Jobs{0}));
  s.start(0);
  EXPECT_TRUE(s.ready(3).empty());
  s.finish(0);
  // 1 finds both steps in the cache; 2 finds the first, which is all that it shares with 1.
  EXPECT_EQ(s.ready(3), (Jobs{1, 2}));
}

TEST(Schedule, ADeeperStepInCommonIsWaitedForAsWell) {
  Schedule s({{"r", "x"}, {"r", "y", "1"}, {"r", "y", "2"}});
  s.start(0);
  s.finish(0);
  EXPECT_EQ(s.ready(3), (Jobs{1}));  // "y" is not in the cache yet
  s.start(1);
  s.finish(1);
  EXPECT_EQ(s.ready(3), (Jobs{2}));
  s.start(2);
  EXPECT_FALSE(s.done());
  s.finish(2);
  EXPECT_TRUE(s.done());
}

TEST(Schedule, EveryOrderComesToItsEnd) {
  for (const std::size_t most : {1u, 2u, 7u}) {
    std::vector<Steps> jobs;
    for (const char* a : {"1", "2"})
      for (const char* b : {"1", "2", "3"})
        for (const char* c : {"1", "2"}) jobs.push_back({a, b, c});
    Schedule s(jobs);
    for (int rounds = 0; !s.done(); ++rounds) {
      ASSERT_LT(rounds, 20);
      const auto ready = s.ready(most);
      ASSERT_FALSE(ready.empty());
      for (const auto i : ready) s.start(i);
      for (const auto i : ready) s.finish(i);
    }
  }
}

}  // namespace
}  // namespace cambium::matrix
