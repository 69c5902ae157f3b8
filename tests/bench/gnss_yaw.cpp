// SPDX-License-Identifier: BSD-3-Clause
// How well yaw can be known from GNSS fixes, and how well it is:
//   bench_gnss_yaw [SEEDS]
// For each path and correlation time the Cramer-Rao bound, the error of gnss_trajectory over the
// seeds (root mean square, with its own standard error), and the sigma that it states. Prints the
// table of docs/gnss.md.
#include <Eigen/LU>
#include <cstdio>
#include <cstdlib>

#include "cambium/path.hpp"
#include "common/receiver.hpp"

namespace cambium::testing {
namespace {

constexpr double sigma = 5;  // [m], each axis

/// No unbiased estimate of yaw is better, whoever makes it and even if the noise is known exactly.
/// An error with first-order Gauss-Markov noise is white once each value less rho times the one
/// before is taken; the rows of the Jacobian by (x, y, yaw) are whitened the same way.
double cramer_rao(const std::vector<Vec3>& places, double correlation_time) {
  const double rho = correlation_time > 0 ? std::exp(-1 / correlation_time) : 0;
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  Eigen::Matrix<double, 2, 3> before = Eigen::Matrix<double, 2, 3>::Zero();
  for (std::size_t i = 0; i < places.size(); ++i) {
    Eigen::Matrix<double, 2, 3> J;
    J << 1, 0, -places[i].y(), 0, 1, places[i].x();
    const Eigen::Matrix<double, 2, 3> white =
        i == 0 ? J : Eigen::Matrix<double, 2, 3>((J - rho * before) / std::sqrt(1 - rho * rho));
    information += white.transpose() * white / (sigma * sigma);
    before = J;
  }
  return std::sqrt(information.inverse()(2, 2));
}

/// Where the robot is at each second.
std::vector<Vec3> each_second(const Mission& mission) {
  std::vector<Vec3> out;
  for (std::size_t i = 0; i + 1 < mission.nodes.size(); ++i) {
    const Node &a = mission.nodes[i], &b = mission.nodes[i + 1];
    const double seconds = seconds_between(*a.stamp, *b.stamp);
    for (double t = 0; t < seconds; ++t)
      out.push_back(interpolate(a.T_mission_node, b.T_mission_node, t / seconds).t);
  }
  out.push_back(mission.nodes.back().T_mission_node.t);
  return out;
}

void row(const char* name, const std::vector<SE3>& poses, double correlation_time, int seeds) {
  const SE3 T_map_enu = SE3::from_yaw(0.9, {50, 60, 7});
  const Mission mission = walked("a", poses, 4);
  double squares = 0, stated = 0;
  for (int seed = 0; seed < seeds; ++seed) {
    const GnssAlignment a =
        align("gnss_trajectory",
              make_atlas({with_receiver(mission, T_map_enu,
                                        {.sigma = sigma, .correlation_time = correlation_time},
                                        1000u + unsigned(seed))}));
    if (!a.georeference) return void(std::printf("| %s | refused: %s |\n", name, a.reason.c_str()));
    squares += std::pow(yaw_error(a, T_map_enu), 2);
    stated += std::pow(a.georeference->sigma_yaw, 2);
  }
  const double deg = gnss::degree, error = std::sqrt(squares / seeds);
  std::printf("| %s | %.0f s | %.3f | %.3f +- %.3f | %.3f |\n", name, correlation_time,
              cramer_rao(each_second(mission), correlation_time) / deg, error / deg,
              error / std::sqrt(2.0 * seeds) / deg, std::sqrt(stated / seeds) / deg);
}

int run(int argc, char** argv) {
  const int seeds = argc > 1 ? std::atoi(argv[1]) : 400;
  if (argc > 2 || seeds < 1) return std::fputs("usage: bench_gnss_yaw [SEEDS]\n", stderr), 2;
  std::printf("1 km at 1 m/s, fixes at 1 Hz with %.0f m of noise on each axis, %d seeds\n", sigma,
              seeds);
  std::puts(
      "| path | correlation time | Cramer-Rao bound [deg] | gnss_trajectory [deg] | stated "
      "[deg] |\n|---|---:|---:|---:|---:|");
  for (const double time : {0.0, 10.0, 30.0, 60.0}) {
    row("winding line", winding(251, 4), time, seeds);
    row("circle", circle(251, 4), time, seeds);
  }
  return 0;
}

}  // namespace
}  // namespace cambium::testing

int main(int argc, char** argv) { return cambium::testing::run(argc, argv); }
