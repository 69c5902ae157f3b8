// SPDX-License-Identifier: BSD-3-Clause
// Every solver on every well-known pose graph:
//   bench_solvers POSE_GRAPHS [NAME=YAML]...
// POSE_GRAPHS is the unpacked archive with REFERENCE.json. Without names: every solver, its
// defaults.
#include <chrono>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "cambium/dialect.hpp"
#include "cambium/files.hpp"
#include "plugins/loader.hpp"
#include "support/pose_graph.hpp"
#include "support/support.hpp"

namespace cambium::testing {
namespace {

using Entry = std::pair<std::string, std::string>;  // solver, parameters

std::vector<Entry> entries(int argc, char** argv) {
  std::vector<Entry> out;
  for (int i = 2; i < argc; ++i) {
    const std::string text = argv[i];
    const std::size_t at = text.find('=');
    out.emplace_back(text.substr(0, at), at == std::string::npos ? "{}" : text.substr(at + 1));
  }
  if (!out.empty()) return out;
  PluginLoader loader;
  loader.load_folder(CAMBIUM_TEST_PLUGINS);
  for (const auto& [key, registered] : loader.registry().all())
    if (key.first == Kind::solver) out.emplace_back(key.second, "{}");
  return out;
}

void bench(const std::string& set, const PoseGraph& graph, double reference, const Entry& entry) {
  const auto context = make_context();
  const auto solver = component<Solver>(entry.first, entry.second);
  const auto start = std::chrono::steady_clock::now();
  const Solution s = solver->solve(graph, *context);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  const double F = cost(graph, s.T_map_node);
  std::printf("| %-14s | %-24s | %10d | %7.3f | %14.6f | %12.9f |\n", set.c_str(),
              (entry.second == "{}" ? entry.first : entry.first + " " + entry.second).c_str(),
              s.iterations, seconds.count(), F, F / reference);
  std::fflush(stdout);
}

int run(int argc, char** argv) {
  if (argc < 2) return std::fputs("usage: bench_solvers POSE_GRAPHS [NAME=YAML]...\n", stderr), 2;
  const std::filesystem::path folder = argv[1];
  const auto reference = nlohmann::json::parse(read_file(folder / "REFERENCE.json"));
  std::printf("| %-14s | %-24s | iterations | seconds | %14s |  F/reference |\n", "set", "solver",
              "F");
  std::puts("|---|---|---:|---:|---:|---:|");
  for (const char* set : {"tinyGrid3D", "smallGrid3D", "parking-garage", "sphere2500", "torus3D"}) {
    const auto graph = pose_graph_from(read_g2o(folder / set / (std::string(set) + ".g2o")));
    for (const auto& entry : entries(argc, argv))
      bench(set, graph, reference.at(set).at("canon"), entry);
  }
  return 0;
}

}  // namespace
}  // namespace cambium::testing

int main(int argc, char** argv) { return cambium::testing::run(argc, argv); }
