// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "cambium/error.hpp"
#include "shards/plan.hpp"

namespace cambium::shards {
namespace {

struct Item {
  SharePart part;
  double cost;
};

// Pairs that would fill more than a quarter of a shard are cut into slices, so that few large
// missions can be balanced as well. A slice repeats the matching, which is cheap.
std::vector<Item> cut(const std::vector<Pair>& pairs, double per_shard) {
  std::vector<Item> out;
  for (const Pair& p : pairs) {
    const auto slices = std::size_t(std::max(1.0, std::ceil(p.cost / (per_shard / 4))));
    for (std::size_t s = 0; s < slices; ++s)
      out.push_back({{p.query, p.reference, s, slices}, p.cost / double(slices)});
  }
  return out;
}

}  // namespace

// Longest processing time first: R. L. Graham, "Bounds on multiprocessing timing anomalies",
// SIAM J. Appl. Math. 17 (1969): at most 4/3 of the best possible.
std::vector<SharePart> shard(const Plan& plan, std::size_t index, std::size_t count) {
  if (index < 1 || index > count)
    throw Error(ErrorCode::config, "--shard", "expected I/N with 1 <= I <= N");
  double total = 0;
  for (const Pair& p : plan.pairs) total += p.cost;
  auto items = cut(plan.pairs, total / double(count));
  std::stable_sort(items.begin(), items.end(),
                   [](const Item& a, const Item& b) { return a.cost > b.cost; });
  std::vector<double> load(count, 0);
  std::vector<SharePart> mine;
  for (const Item& item : items) {
    const auto least = std::min_element(load.begin(), load.end());
    *least += item.cost;
    if (least - load.begin() == std::ptrdiff_t(index - 1)) mine.push_back(item.part);
  }
  return mine;
}

}  // namespace cambium::shards
