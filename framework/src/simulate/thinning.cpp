// SPDX-License-Identifier: BSD-3-Clause
#include "simulate/thinning.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace cambium::simulate {
namespace {

/// Places in square cells of the width of the distance that is asked about.
class Cells {
 public:
  explicit Cells(double distance) : distance_(distance) {}
  void add(const Place& p) { cells_[{cell(p.x), cell(p.y)}].push_back(&p); }

  /// Whether `predicate` holds for a place nearer than the distance.
  template <class Predicate>
  bool any_near(const Place& p, Predicate predicate) const {
    for (std::int64_t dx = -1; dx <= 1; ++dx)
      for (std::int64_t dy = -1; dy <= 1; ++dy) {
        const auto it = cells_.find({cell(p.x) + dx, cell(p.y) + dy});
        if (it == cells_.end()) continue;
        for (const Place* q : it->second)
          if (std::hypot(q->x - p.x, q->y - p.y) < distance_ && predicate(*q)) return true;
      }
    return false;
  }

 private:
  std::int64_t cell(double v) const { return std::int64_t(std::floor(v / distance_)); }
  double distance_;
  std::map<std::pair<std::int64_t, std::int64_t>, std::vector<const Place*>> cells_;
};

}  // namespace

std::vector<Place> thinned(const std::vector<Place>& places, double distance) {
  Cells cells(distance);
  for (const Place& p : places) cells.add(p);
  std::vector<Place> out;
  for (const Place& p : places)
    if (!cells.any_near(p, [&](const Place& q) { return q.mark < p.mark; })) out.push_back(p);
  return out;
}

std::vector<bool> spread(const std::vector<Place>& places, double distance) {
  std::vector<std::size_t> order(places.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return places[a].mark < places[b].mark; });
  std::vector<bool> out(places.size(), false);
  Cells cells(distance);
  for (const std::size_t i : order) {
    out[i] = !cells.any_near(places[i], [](const Place&) { return true; });
    if (out[i]) cells.add(places[i]);
  }
  return out;
}

}  // namespace cambium::simulate
