// SPDX-License-Identifier: BSD-3-Clause
#include "simulate/tree_table.hpp"

#include <algorithm>
#include <cmath>

#include "simulate/angles.hpp"

namespace cambium::simulate {
namespace {

double smooth(double low, double high, double x) {
  const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

// Close by, the lidar sees too little of a stem's length; far away, too few points.
double reconstruction_range(double range, double max_range) {
  return smooth(1.0, 9.0, range) * (1 - smooth(0.4 * max_range, 0.95 * max_range, range));
}
double detection_range(double range, double max_range) {
  return std::pow(std::clamp((max_range - range) / (0.8 * max_range), 0.0, 1.0), 1.3);
}
double logistic(double x) { return 1 / (1 + std::exp(-x)); }

class Detector {
 public:
  Detector(const TreesSpec& spec, const SE3& T_world_base, const Random& node)
      : spec_(spec), T_base_world_(T_world_base.inverse()), node_(node) {}

  void look_at_stem(const Stem& s) {
    const double range = range_of(s.base);
    if (range > spec_.max_range) return;
    Random r = node_.fork(s.mark);
    // Most of the luck belongs to the stem, so that neighbouring nodes agree.
    const double luck = Random(s.mark, "luck").uniform() + 0.02 * r.normal();
    const double thick = logistic((s.dbh - spec_.min_dbh) / 0.02);
    if (luck < thick * reconstruction_range(range, spec_.max_range)) {
      add(s, r, true);
      table.stems.push_back(s.mark);
    } else if (Random(s.mark, "seen").uniform() + 0.03 * r.normal() <
               0.35 * detection_range(range, spec_.max_range)) {
      add(s, r, false);
      table.stems.push_back(s.mark);
    }
  }

  void look_at_clutter(const Stem& s) {
    const double range = range_of(s.base);
    if (range > spec_.max_range) return;
    Random r = node_.fork(s.mark);
    if (Random(s.mark, "seen").uniform() + 0.03 * r.normal() <
        0.55 * detection_range(range, spec_.max_range))
      add(s, r, false);
  }

  /// A detection where nothing stands; like the others, they are denser close by.
  void imagine(const Terrain& terrain, const Vec3& center) {
    Random r = node_.fork(~std::uint64_t{0});
    for (int n = r.poisson(spec_.spurious); n > 0; --n) {
      Stem s;
      const double range = spec_.max_range * std::min(r.uniform(), r.uniform());
      const double angle = r.uniform(0, 2 * std::numbers::pi);
      s.base = center + range * Vec3(std::cos(angle), std::sin(angle), 0);
      s.base.z() = terrain.height(s.base.x(), s.base.y());
      s.dbh = r.uniform(0.08, 0.5);
      Random own = r.fork(std::uint64_t(n));
      add(s, own, false);
    }
  }

  TreeTable table;

 private:
  double range_of(const Vec3& p_world) const { return (T_base_world_ * p_world).head<2>().norm(); }

  void add(const Stem& s, Random& r, bool reconstructed) {
    // What was only detected is known about three times worse.
    const double worse = reconstructed ? 1 : 3;
    Vec3 noise;
    for (int k = 0; k < 2; ++k) noise[k] = worse * spec_.position_noise * r.normal();
    noise.z() = spec_.height_noise * r.normal();
    const double bend = (reconstructed ? 1 : 1.7) * radians(spec_.axis_noise);
    const double about_x = bend * r.normal(), about_y = bend * r.normal();
    Tree tree;
    tree.base = T_base_world_ * (s.base + noise);
    const Vec3 axis = Quat::FromTwoVectors(Vec3::UnitZ(), s.axis) * leaning(about_x, about_y);
    tree.axis = T_base_world_.q * axis;
    tree.dbh = std::max(0.03, s.dbh + worse * spec_.dbh_noise * r.normal());
    tree.score = score(r, reconstructed);
    tree.reconstructed = reconstructed;
    table.trees.push_back(tree);
  }

  // Quartiles of the real ones: 0.79, 0.93, 0.98 when reconstructed, else 0.24, 0.32, 0.49.
  static double score(Random& r, bool reconstructed) {
    const double u = r.uniform();
    return reconstructed ? 1 - 0.25 * std::pow(u, 2) - 0.6 * std::pow(u, 12)
                         : 0.15 + 0.35 * u + 0.5 * std::pow(u, 6);
  }

  const TreesSpec& spec_;
  SE3 T_base_world_;
  Random node_;
};

}  // namespace

TreeTable detect(const TreesSpec& spec, const SE3& T_world_base, const std::vector<Stem>& stems,
                 const std::vector<Stem>& clutter, const Terrain& terrain, const Random& node) {
  Detector detector(spec, T_world_base, node);
  for (const Stem& s : stems) detector.look_at_stem(s);
  for (const Stem& s : clutter) detector.look_at_clutter(s);
  detector.imagine(terrain, T_world_base.t);
  TreeTable& out = detector.table;
  std::sort(out.stems.begin(), out.stems.end());
  // In the order of the stem map, a matcher could pair rows by their number.
  Random order = node.fork(1);
  for (std::size_t i = out.trees.size(); i > 1; --i)
    std::swap(out.trees[i - 1], out.trees[std::size_t(order.uniform() * double(i))]);
  return std::move(out);
}

}  // namespace cambium::simulate
