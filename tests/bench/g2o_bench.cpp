// SPDX-License-Identifier: BSD-3-Clause
// How fast pose graphs are read and written: bench_g2o [megabytes]. One thread.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <sstream>

#include "cambium/dialect.hpp"

namespace {

using namespace cambium;

/// Processor time: other programs on the machine do not count.
double seconds_of(const std::function<void()>& work) {
  double best = 1e9;  // of three: the least disturbed one
  for (int i = 0; i < 3; ++i) {
    const std::clock_t start = std::clock();
    work();
    best = std::min(best, double(std::clock() - start) / CLOCKS_PER_SEC);
  }
  return best;
}

/// A spiral with a loop edge for every node, full digits: 560 bytes of text a node.
Mission spiral(std::size_t nodes) {
  Mission m;
  m.name = "spiral";
  for (std::size_t i = 0; i < nodes; ++i) {
    const double a = 0.01 * double(i);
    Node node;
    node.id = NodeId(i);
    node.stamp = Stamp{1700000000 + std::int64_t(i), 123456789};
    node.T_mission_node = SE3::from_yaw(a, Vec3(a * std::cos(a), a * std::sin(a), 0.1 * a));
    m.nodes.push_back(std::move(node));
  }
  const auto connect = [&](std::size_t tail, std::size_t head, EdgeKind kind) {
    Edge e;
    e.kind = kind;
    e.tail = NodeId(tail);
    e.head = NodeId(head);
    e.T_tail_head = m.nodes[tail].T_mission_node.inverse() * m.nodes[head].T_mission_node;
    e.information.diagonal() << 400, 400, 400, 10000, 10000, 10000;
    e.tag = "EDGE_SE3:QUAT";
    m.edges.push_back(e);
  };
  for (std::size_t i = 1; i < nodes; ++i) connect(i - 1, i, EdgeKind::odometry);
  for (std::size_t i = 628; i < nodes; ++i) connect(i - 628, i, EdgeKind::loop);
  return m;
}

void row(const char* name, const Mission& mission) {
  std::string text;
  const double write = seconds_of([&] {
    std::ostringstream out;
    write_g2o(out, mission);
    text = out.str();
  });
  const double read = seconds_of([&] { parse_g2o(text, "bench.g2o"); });
  const double megabytes = 1e-6 * double(text.size());
  std::printf("%-14s %9zu %9zu %8.1f %9.3f %9.1f %9.3f %9.1f\n", name, mission.nodes.size(),
              mission.edges.size(), megabytes, read, megabytes / read, write, megabytes / write);
}

}  // namespace

int main(int argc, char** argv) {
  const double megabytes = argc > 1 ? std::atof(argv[1]) : 100;
  std::printf("%-14s %9s %9s %8s %9s %9s %9s %9s\n", "graph", "nodes", "edges", "MB", "read s",
              "MB/s", "write s", "MB/s");
  row("100k vertices", spiral(100000));
  row("large", spiral(std::size_t(megabytes * 1e6 / 560)));
  return 0;
}
