// SPDX-License-Identifier: BSD-3-Clause
// Work spread over the threads of an arena.
#pragma once
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <thread>
#include <vector>

namespace cambium {

/// body(0) ... body(count - 1), side by side; must not throw. Items are dealt out one by one: they
/// take milliseconds and differ much, and a thread that is left with a block of them keeps the
/// others waiting at the end.
///
/// Under ThreadSanitizer on plain threads: Debian's TBB is not instrumented, so each hand-over of
/// work inside it would read as a data race, and a real one would drown among them.
template <class Body>
void in_parallel(tbb::task_arena& arena, std::size_t count, const Body& body) {
#if defined(__SANITIZE_THREAD__)
  std::atomic<std::size_t> next{0};
  std::vector<std::jthread> pool;
  for (int t = 0; t < arena.max_concurrency(); ++t)
    pool.emplace_back([&] {
      for (std::size_t i; (i = next++) < count;) body(i);
    });
#else
  arena.execute([&] {
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, count, 1),
        [&](const auto& range) {
          for (std::size_t i = range.begin(); i != range.end(); ++i) body(i);
        },
        tbb::simple_partitioner());
  });
#endif
}

}  // namespace cambium
