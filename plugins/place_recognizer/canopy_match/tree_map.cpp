// SPDX-License-Identifier: BSD-3-Clause
#include "tree_map.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>

#include "cambium/statistics.hpp"

namespace canopy_match {
namespace {

using cambium::SE3;
using cambium::Vec3;

struct Cluster {
  Vec3 sum = Vec3::Zero();
  std::vector<double> heights;
  std::size_t last_node = 0, sightings = 0;
  Vec3 centre() const { return sum / double(heights.size()); }
};

/// Clusters by the cell that their centre lies in, so that near ones are found.
class Clusters {
 public:
  explicit Clusters(double radius) : radius_(radius) {}

  void add(const Vec3& p, std::size_t node) {
    const std::size_t nearest = find(p);
    if (nearest == none) {
      clusters_.push_back({p, {p.z()}, node, 1});
      cells_[cell(p)].push_back(clusters_.size() - 1);
      return;
    }
    Cluster& c = clusters_[nearest];
    c.sum += p;
    c.heights.push_back(p.z());
    if (c.last_node != node) ++c.sightings;
    c.last_node = node;
  }

  std::vector<Vec3> trees(std::size_t min_sightings) const {
    std::vector<Vec3> out;
    for (const Cluster& c : clusters_)
      if (c.sightings >= min_sightings)
        out.push_back({c.centre().x(), c.centre().y(), cambium::median(c.heights)});
    return out;
  }

 private:
  static constexpr std::size_t none = ~std::size_t(0);
  using Cell = std::pair<long, long>;

  Cell cell(const Vec3& p) const {
    return {std::lround(p.x() / radius_), std::lround(p.y() / radius_)};
  }
  std::size_t find(const Vec3& p) const {
    std::size_t best = none;
    double least = radius_;
    const auto [x, y] = cell(p);
    for (long dx = -2; dx <= 2; ++dx)  // a centre may have moved out of the cell that holds it
      for (long dy = -2; dy <= 2; ++dy) {
        const auto it = cells_.find({x + dx, y + dy});
        if (it == cells_.end()) continue;
        for (const std::size_t i : it->second) {
          const double d = (clusters_[i].centre() - p).head<2>().norm();
          if (d < least) least = d, best = i;
        }
      }
    return best;
  }

  double radius_;
  std::vector<Cluster> clusters_;
  std::map<Cell, std::vector<std::size_t>> cells_;
};

template <class T>
void append(std::vector<std::byte>& bytes, const std::vector<T>& values) {
  const auto from = std::as_bytes(std::span(values));
  bytes.insert(bytes.end(), from.begin(), from.end());
}

}  // namespace

TreeMap map_trees(const cambium::MissionView& mission, double radius, int min_sightings,
                  const cambium::Context& context) {
  TreeMap out;
  Clusters clusters(radius);
  for (std::size_t i = 0; i < mission.size(); ++i) {
    context.check_cancelled();
    const SE3& T = mission.mission().nodes[i].T_mission_node;
    out.T_mission_node.push_back(T);
    const auto payload = mission.payload(i);
    if (!payload.trees) continue;
    for (const cambium::Tree& tree : *payload.trees) {
      const Vec3 p = T * tree.base;
      if (p.allFinite() && p.norm() < 1e6) clusters.add(p, i);
    }
  }
  const auto asked = std::size_t(std::max(1, min_sightings));
  out.trees = clusters.trees(mission.size() < asked ? 1 : asked);
  return out;
}

cambium::Fingerprints to_fingerprints(const TreeMap& map) {
  cambium::Fingerprints out{map.T_mission_node.size(), 0, {}, {}};
  append(out.extra, map.T_mission_node);
  append(out.extra, map.trees);
  return out;
}

TreeMap from_fingerprints(const cambium::Fingerprints& fingerprints) {
  const std::size_t poses = fingerprints.rows * sizeof(SE3), all = fingerprints.extra.size();
  if (all < poses || (all - poses) % sizeof(Vec3) != 0)
    throw cambium::Error(cambium::ErrorCode::data, "canopy_match",
                         "expected poses and trees in the fingerprints, found " +
                             std::to_string(all) + " bytes for " +
                             std::to_string(fingerprints.rows) + " nodes");
  TreeMap out;
  out.T_mission_node.resize(fingerprints.rows);
  out.trees.resize((all - poses) / sizeof(Vec3));
  // SE3's members have fixed sizes and no pointers: copying bytes copies values.
  if (poses > 0)
    std::memcpy(static_cast<void*>(out.T_mission_node.data()), fingerprints.extra.data(), poses);
  if (!out.trees.empty())
    std::memcpy(static_cast<void*>(out.trees.data()), fingerprints.extra.data() + poses,
                all - poses);
  return out;
}

}  // namespace canopy_match
