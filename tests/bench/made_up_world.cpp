// SPDX-License-Identifier: BSD-3-Clause
#include "made_up_world.hpp"

#include <cmath>
#include <numbers>

namespace cambium::bench {
namespace {

constexpr double pi = std::numbers::pi;

/// 0..1 from up to three integers (a step of splitmix64 each).
double hashed(std::uint64_t a, std::uint64_t b, std::uint64_t c) {
  const auto mix = [](std::uint64_t x) {
    x += 0x9e3779b97f4a7c15u;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
  };
  return double(mix(mix(mix(a) ^ b) ^ c) >> 11) * 0x1p-53;
}

std::uint64_t cell(double x, double size) {
  return std::uint64_t(std::int64_t(std::floor(x / size)));
}

/// Height above the ground [m]: one cell of 12 m in four is a block, of the others every third has
/// a tree of 3 m.
double height(double x, double y) {
  if (hashed(cell(x, 12), cell(y, 12), 1) < 0.25)
    return 4 + 16 * hashed(cell(x, 12), cell(y, 12), 2);
  if (hashed(cell(x, 3), cell(y, 3), 3) < 0.33) return 3 + 9 * hashed(cell(x, 3), cell(y, 3), 4);
  return 0.4 * hashed(cell(x, 3), cell(y, 3), 5);
}

class MadeUpScan final : public PayloadSource {
 public:
  MadeUpScan(World world, std::size_t step, double shift)
      : world_(world), step_(step), shift_(shift) {}
  Payload load() const override {
    auto cloud = std::make_shared<Cloud>();
    const double heading = 2 * pi * hashed(step_, std::uint64_t(1000 * shift_), 6);
    for (std::uint64_t bin = 0; bin < 1200; ++bin) {
      const double range = 4.0 * (double(bin % 20) + hashed(step_, bin, 7));
      const double azimuth = 2 * pi * (double(bin / 20) + hashed(step_, bin, 8)) / 60;
      const double x = double(step_) + range * std::cos(azimuth);
      const double y = shift_ + range * std::sin(azimuth);
      // Farther than what stands in the way there is little to see.
      const double reach = 15 + 65 * hashed(cell(x, 60), cell(azimuth, 0.2), 9);
      if (hashed(step_, bin, 10) > (range < reach ? 0.95 : 0.1)) continue;
      double z = height(x, y) - 1.5;
      if (world_ == World::alike) z = 8 * hashed(bin, 0, 11) + 0.3 * hashed(step_, bin, 12);
      const double a = azimuth - heading;
      cloud->xyz.insert(cloud->xyz.end(),
                        {float(range * std::cos(a)), float(range * std::sin(a)), float(z)});
    }
    return {cloud, nullptr};
  }
  Digest digest() const override { return {}; }
  std::string where() const override { return "made up"; }

 private:
  World world_;
  std::size_t step_;
  double shift_;
};

}  // namespace

Mission made_up_mission(World world, const std::string& name, const std::vector<std::size_t>& steps,
                        double beside) {
  Mission mission;
  mission.name = name;
  mission.nodes.resize(steps.size());
  for (std::size_t i = 0; i < steps.size(); ++i) {
    mission.nodes[i].id = std::int64_t(i);
    mission.nodes[i].T_mission_node = SE3{Quat::Identity(), {double(steps[i]), beside, 0}};
    mission.nodes[i].payload = std::make_shared<MadeUpScan>(world, steps[i], beside);
  }
  return mission;
}

}  // namespace cambium::bench
