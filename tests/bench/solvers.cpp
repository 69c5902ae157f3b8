// SPDX-License-Identifier: BSD-3-Clause
// Every solver on every well-known pose graph:
//   bench_solvers [--peers PYTHON] POSE_GRAPHS [NAME=YAML]...
//   bench_solvers --growth [NAME=YAML]...
// POSE_GRAPHS is the unpacked archive with REFERENCE.json. Without names: every solver, its
// defaults, those of GTSAM and g2o too when their plugins were built. --peers adds GTSAM by
// gtsam_peer.py, run by that interpreter, in the same run. Pin the whole to one core (taskset -c
// 0); the seconds are those of the CPU.
#include <cstdio>
#include <ctime>
#include <nlohmann/json.hpp>

#include "cambium/dialect.hpp"
#include "cambium/files.hpp"
#include "growth.hpp"
#include "plugins/loader.hpp"
#include "support/places.hpp"
#include "support/pose_graph.hpp"
#include "support/support.hpp"

namespace cambium::testing {
namespace {

using Entry = std::pair<std::string, std::string>;  // solver, parameters

std::vector<Entry> entries(const std::vector<std::string>& names) {
  std::vector<Entry> out;
  for (const std::string& text : names) {
    const std::size_t at = text.find('=');
    out.emplace_back(text.substr(0, at), at == std::string::npos ? "{}" : text.substr(at + 1));
  }
  if (!out.empty()) return out;
  PluginLoader loader;
  loader.load_folder(plugin_folder());
  for (const auto& [key, registered] : loader.registry().all())
    if (key.first == Kind::solver) out.emplace_back(key.second, "{}");
  return out;
}

void row(const std::string& set, const std::string& solver, int iterations, double seconds,
         double F, double reference) {
  std::printf("| %-14s | %-24s | %10d | %7.3f | %14.6f | %12.9f |\n", set.c_str(), solver.c_str(),
              iterations, seconds, F, F / reference);
  std::fflush(stdout);
}

void bench(const std::string& set, const PoseGraph& graph, double reference, const Entry& entry) {
  const auto context = make_context();
  const auto solver = component<Solver>(entry.first, entry.second);
  const std::clock_t start = std::clock();
  const Solution s = solver->solve(graph, *context);
  const double seconds = double(std::clock() - start) / CLOCKS_PER_SEC;
  row(set, entry.second == "{}" ? entry.first : entry.first + " " + entry.second, s.iterations,
      seconds, cost(graph, s.T_map_node), reference);
}

void bench_gtsam(const std::string& python, const std::string& set,
                 const std::filesystem::path& file, double reference) {
  const std::string command =
      python + " " + source("tests/bench/gtsam_peer.py").string() + " " + file.string();
  std::FILE* pipe = ::popen(command.c_str(), "r");
  int iterations = 0;
  double seconds = 0, F = 0;
  const bool ran = pipe && std::fscanf(pipe, "%d %lf %lf", &iterations, &seconds, &F) == 3;
  if (pipe) ::pclose(pipe);
  if (ran)
    row(set, "GTSAM (peer)", iterations, seconds, F, reference);
  else
    std::printf("| %-14s | GTSAM (peer) did not run: %s |\n", set.c_str(), command.c_str());
}

int run(int argc, char** argv) {
  std::vector<std::string> arguments(argv + 1, argv + argc);
  std::string python;
  if (arguments.size() > 1 && arguments[0] == "--peers") {
    python = arguments[1];
    arguments.erase(arguments.begin(), arguments.begin() + 2);
  }
  if (!arguments.empty() && arguments[0] == "--growth") {
    arguments.erase(arguments.begin());
    return bench_growth(entries(arguments)), 0;
  }
  if (arguments.empty())
    return std::fputs(
               "usage: bench_solvers [--peers PYTHON] POSE_GRAPHS [NAME=YAML]...\n"
               "       bench_solvers --growth [NAME=YAML]...\n",
               stderr),
           2;
  const std::filesystem::path folder = arguments[0];
  arguments.erase(arguments.begin());
  const auto reference = nlohmann::json::parse(read_file(folder / "REFERENCE.json"));
  std::printf("| %-14s | %-24s | iterations | seconds | %14s |  F/reference |\n", "set", "solver",
              "F");
  std::puts("|---|---|---:|---:|---:|---:|");
  for (const char* set : {"tinyGrid3D", "smallGrid3D", "parking-garage", "sphere2500", "torus3D"}) {
    const auto file = folder / set / (std::string(set) + ".g2o");
    const auto graph = pose_graph_from(read_g2o(file));
    const double optimum = reference.at(set).at("canon");
    for (const auto& entry : entries(arguments)) bench(set, graph, optimum, entry);
    if (!python.empty()) bench_gtsam(python, set, file, optimum);
  }
  return 0;
}

}  // namespace
}  // namespace cambium::testing

int main(int argc, char** argv) try {
  return cambium::testing::run(argc, argv);
} catch (const std::exception& e) {
  return std::fprintf(stderr, "%s\n", e.what()), 1;
}
