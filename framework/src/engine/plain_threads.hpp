// SPDX-License-Identifier: BSD-3-Clause
// Instead of TBB under ThreadSanitizer: Debian's TBB is not instrumented, so each hand-over of work
// inside it would read as a data race, and a real one would drown among them.
#pragma once
#include <atomic>
#include <thread>
#include <vector>

namespace cambium {

/// body(0) ... body(count - 1) on `threads` threads; must not throw.
template <class Body>
void on_plain_threads(int threads, std::size_t count, const Body& body) {
  std::atomic<std::size_t> next{0};
  std::vector<std::jthread> pool;
  for (int t = 0; t < threads; ++t)
    pool.emplace_back([&] {
      for (std::size_t i; (i = next++) < count;) body(i);
    });
}

}  // namespace cambium
