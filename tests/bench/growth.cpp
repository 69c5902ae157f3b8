// SPDX-License-Identifier: BSD-3-Clause
#include "growth.hpp"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <ctime>
#include <random>

#include "support/pose_graph.hpp"
#include "support/support.hpp"

namespace cambium::testing {
namespace {

constexpr double sigma_t = 0.05, sigma_r = 0.01;  // of every edge [m, rad]
constexpr double spacing = 2;                     // [m]

struct Grid {
  const char* shape;
  int side, floors;
};

/// There and back in every row, row after row, floor after floor.
std::vector<Eigen::Vector3i> path(const Grid& grid) {
  std::vector<Eigen::Vector3i> out;
  for (int z = 0; z < grid.floors; ++z)
    for (int i = 0; i < grid.side; ++i) {
      const int y = z % 2 ? grid.side - 1 - i : i;
      const bool back = (z * grid.side + i) % 2;
      for (int j = 0; j < grid.side; ++j) out.emplace_back(back ? grid.side - 1 - j : j, y, z);
    }
  return out;
}

/// Odometry along the path and a loop to every neighbour but it. The given poses are dead reckoned.
PoseGraph graph_of(const Grid& grid) {
  std::mt19937_64 engine(7);
  std::normal_distribution<double> normal;
  const auto cells = path(grid);
  const auto at = [&](const Eigen::Vector3i& c) {
    return std::size_t((c.z() * grid.side + c.y()) * grid.side + c.x());
  };
  std::vector<std::size_t> index(cells.size());
  std::vector<SE3> truth;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    index[at(cells[i])] = i;
    truth.push_back(SE3::from_yaw(0.1 * double(i % 60), spacing * cells[i].cast<double>()));
  }
  PoseGraph g;
  const auto connect = [&](std::size_t tail, std::size_t head, bool loop) {
    Vec6 xi;
    for (int k = 0; k < 6; ++k) xi[k] = (k < 3 ? sigma_t : sigma_r) * normal(engine);
    Mat6 information = Mat6::Identity() / (sigma_t * sigma_t);
    information.bottomRightCorner<3, 3>() = Mat3::Identity() / (sigma_r * sigma_r);
    g.relative.push_back(
        {tail, head, truth[tail].inverse() * truth[head] * SE3::exp(xi), information, loop, ""});
  };
  g.T_map_node = {truth[0]};
  for (std::size_t i = 1; i < cells.size(); ++i) {
    connect(i - 1, i, false);
    g.T_map_node.push_back(g.T_map_node.back() * g.relative.back().T_tail_head);
  }
  for (std::size_t i = 0; i < cells.size(); ++i)
    for (int axis = 0; axis < 3; ++axis) {
      Eigen::Vector3i next = cells[i];
      if (++next[axis] == (axis < 2 ? grid.side : grid.floors)) continue;
      const auto [low, high] = std::minmax(i, index[at(next)]);
      if (high > low + 1) connect(low, high, true);
    }
  for (std::size_t i = 0; i < cells.size(); ++i) g.ids.push_back(NodeId(i));
  g.fixed.assign(cells.size(), false);
  g.fixed[0] = true;
  return g;
}

void solve_and_print(const Grid& grid, const std::string& name, const std::string& yaml) {
  const PoseGraph graph = graph_of(grid);
  const auto context = make_context();
  const auto solver = component<Solver>(name, yaml);
  const std::clock_t start = std::clock();
  const Solution s = solver->solve(graph, *context);
  const double seconds = double(std::clock() - start) / CLOCKS_PER_SEC;
  const double megabytes = [] {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return double(usage.ru_maxrss) / 1024;
  }();
  const double freedom = 6.0 * double(graph.relative.size() - graph.T_map_node.size() + 1);
  std::printf("| %-5s | %6zu | %6zu | %-20s | %4d%s | %9.3f | %9.4f | %8.0f | %10.4f |\n",
              grid.shape, graph.T_map_node.size(), graph.relative.size(), name.c_str(),
              s.iterations, s.converged ? " " : "*", seconds, seconds / s.iterations, megabytes,
              cost(graph, s.T_map_node) / freedom);
}

}  // namespace

void bench_growth(const std::vector<std::pair<std::string, std::string>>& solvers) {
  // F of an optimum is near the degrees of freedom: edges beyond a tree, times six.
  std::puts(
      "| shape | poses | edges | solver | iterations | seconds | seconds / iteration | peak MB "
      "| F / freedom |");
  std::puts("|---|---:|---:|---|---:|---:|---:|---:|---:|");
  const Grid grids[] = {{"slab", 16, 4},  {"slab", 50, 4},  {"slab", 90, 4},  {"slab", 158, 4},
                        {"cube", 10, 10}, {"cube", 15, 15}, {"cube", 22, 22}, {"cube", 30, 30}};
  for (const Grid& grid : grids)
    for (const auto& [name, yaml] : solvers) {
      std::fflush(stdout);
      const pid_t child = fork();
      if (child == 0) {
        solve_and_print(grid, name, yaml);
        std::fflush(stdout);
        _exit(0);
      }
      int status = 0;
      waitpid(child, &status, 0);
      if (status != 0)
        std::printf("| %-5s | %6d | | %-20s | ended with status %d |\n", grid.shape,
                    grid.side * grid.side * grid.floors, name.c_str(), status);
    }
}

}  // namespace cambium::testing
