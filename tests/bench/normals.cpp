// SPDX-License-Identifier: BSD-3-Clause
// What stable_normals keeps of simulated forests, and how right its normals are:
//   bench_normals [STABLE_NORMALS_PARAMS]
// On submaps (the filter submap) and on single scans of a walk through the default stand.
#include <cmath>
#include <cstdio>
#include <map>

#include "bench/stem_data.hpp"
#include "cambium/statistics.hpp"

namespace {

using namespace cambium;
using namespace cambium::bench;
using cambium::testing::component;

enum Class { ground, stem, other };

struct Truth {
  Class kind;
  Vec3 normal;  ///< of the surface, either way
};

/// What a point lies on: drift and noise put it up to a decimetre beside.
Truth truth_of(const Forest& forest, const Vec3& p) {
  const double height = p.z() - forest.terrain.height(p.x(), p.y());
  for (const simulate::Stem& s : forest.stems) {
    if ((s.base - p).head<2>().norm() > 2.0) continue;
    const double along = (p - s.base).dot(s.axis);
    const Vec3 off = p - s.base - along * s.axis;
    const bool near = std::abs(off.norm() - s.radius_at(along)) < 0.08;
    if (near && height > 0.3 && along < 0.5 * s.height) return {stem, off.normalized()};
  }
  if (std::abs(height) < 0.1) return {ground, Vec3::UnitZ()};
  return {other, Vec3::Zero()};
}

struct Count {
  double all = 0, kept = 0;
  std::vector<double> angles;  ///< of the normals [deg]
};

std::map<Class, Count> judge_normals(const Forest& forest, std::size_t node, const Cloud& cloud,
                                     const Cloud& kept) {
  constexpr double range = 15.0;
  const SE3& T = forest.T_world_node[node];
  std::map<Class, Count> out;
  const auto each = [&](const Cloud& c, auto visit) {
    for (Eigen::Index i = 0; i < c.points().cols(); i += 5) {
      const Vec3 p = c.points().col(i).cast<double>();
      if (p.head<2>().norm() < range) visit(std::size_t(i), truth_of(forest, T * p));
    }
  };
  each(cloud, [&](std::size_t, const Truth& t) { out[t.kind].all += 1; });
  each(kept, [&](std::size_t i, const Truth& t) {
    out[t.kind].kept += 1;
    const Vec3 n(kept.normals[3 * i], kept.normals[3 * i + 1], kept.normals[3 * i + 2]);
    out[t.kind].angles.push_back(57.3 *
                                 std::acos(std::min(1.0, std::abs((T.q * n).dot(t.normal)))));
  });
  return out;
}

void print(const char* what, int beams, const Forest& forest, const std::string& yaml, bool join) {
  const auto submap = component<PayloadFilter>("submap");
  const auto filter = component<PayloadFilter>("stable_normals", yaml);
  std::map<Class, Count> sum;
  double seconds = 0, unused = 0, points = 0, nodes = 0;
  for (std::size_t node = 10; node < 21; node += 5, ++nodes) {
    const Payload raw = join ? filtered(forest, node, *submap, unused)
                             : forest.atlas.payload({0, std::uint32_t(node)});
    const Payload kept = filtered(with_payload(forest, node, raw), node, *filter, seconds);
    points += double(raw.cloud->size());
    for (auto& [kind, count] : judge_normals(forest, node, *raw.cloud, *kept.cloud)) {
      sum[kind].all += count.all, sum[kind].kept += count.kept;
      sum[kind].angles.insert(sum[kind].angles.end(), count.angles.begin(), count.angles.end());
    }
  }
  const auto share = [&](Class kind) { return 100 * sum[kind].kept / sum[kind].all; };
  std::printf("| %s | %d | %.0f | %.0f | %.0f | %.0f | %.1f | %.1f | %.0f |\n", what, beams,
              points / nodes / 1000, share(ground), share(stem), share(other),
              median(sum[ground].angles), median(sum[stem].angles), 1e3 * seconds / nodes);
}

}  // namespace

int main(int argc, char** argv) try {
  const std::string yaml = argc > 1 ? argv[1] : "{}";
  std::printf(
      "| cloud | beams | 1000 points | ground kept [%%] | stems kept [%%] | other kept [%%] | "
      "ground: median angle [deg] | stems: median angle [deg] | ms |\n"
      "|---|---|---|---|---|---|---|---|---|\n");
  for (const int beams : {64, 16}) {
    const Forest forest = grow_forest(specification({10, beams, 0.5, 21}));
    print("submap", beams, forest, yaml, true);
    print("scan", beams, forest, yaml, false);
  }
} catch (const std::exception& e) {
  std::fprintf(stderr, "%s\n", e.what());
  return 1;
}
