// SPDX-License-Identifier: BSD-3-Clause
// Aligners on real fixes, and the hdl_graph_slam graph with and without its GNSS priors:
//   bench_gnss GNSS        the unpacked archive
// Prints the tables of docs/gnss.md.
#include <algorithm>
#include <cstdio>

#include "cambium/dialect.hpp"
#include "cambium/fit.hpp"
#include "cambium/geodesy.hpp"
#include "cambium/statistics.hpp"
#include "gnss_data.hpp"
#include "support/pose_graph.hpp"
#include "support/support.hpp"

namespace cambium::testing {
namespace {

constexpr double degree = 57.29577951308232;

std::string score(const GnssAlignment& a, const std::string& name) {
  char text[32] = "";
  for (const auto& [key, value] : a.scores)
    if (key == name) std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

/// Distances of the fixes from the path by an alignment, nodes and fixes at the same times.
void row(const char* set, const char* plugin, const Mission& mission) {
  const Atlas atlas = make_atlas({mission});
  const GnssAlignment a =
      component<GnssAligner>(plugin)->align(atlas, atlas.islands[0], *make_context());
  if (!a.georeference)
    return void(std::printf("| %s | %s | %s |\n", set, plugin, a.reason.c_str()));
  const GeoReference& g = *a.georeference;
  std::vector<double> horizontal, vertical;
  for (std::size_t i = 0; i < mission.nodes.size(); ++i) {
    const GnssFix& fix = mission.fixes[i];
    const Vec3 r = g.T_map_enu * to_enu({g.latitude, g.longitude, g.altitude},
                                        {fix.latitude, fix.longitude, fix.altitude}) -
                   mission.nodes[i].T_mission_node.t;
    horizontal.push_back(r.head<2>().norm());
    vertical.push_back(std::abs(r.z()));
  }
  std::printf("| %s | %s | %.3f | %.3f | %.2f | %.2f | %.2f | %.2f | %s | %s |\n", set, plugin,
              g.T_map_enu.yaw() * degree, g.sigma_yaw * degree, median(horizontal), rms(horizontal),
              *std::max_element(horizontal.begin(), horizontal.end()), median(vertical),
              score(a, "outliers").c_str(), score(a, "effective_fixes").c_str());
}

std::vector<double> from_priors(const Mission& mission, const std::vector<SE3>& poses,
                                bool aligned) {
  std::vector<Vec3> measured, mapped;
  for (const Edge& e : mission.edges)
    if (e.kind == EdgeKind::position) {
      measured.push_back(e.T_tail_head.t);
      mapped.push_back(poses[*mission.index_of(e.head)].t);
    }
  const SE3 T = aligned ? fit_yaw(measured, mapped) : SE3{};
  std::vector<double> out;
  for (std::size_t i = 0; i < measured.size(); ++i)
    out.push_back((measured[i] - T * mapped[i]).head<2>().norm());
  return out;
}

void solve(const char* what, Mission mission, const Mission& with_priors) {
  PoseGraph graph = pose_graph_from(mission);
  const Solution s =
      component<Solver>("sparse_lm", "{loss: cauchy}")->solve(graph, *make_context());
  for (const bool aligned : {false, true}) {
    const auto off = from_priors(with_priors, s.T_map_node, aligned);
    std::printf("| %s%s | %.6g | %.2f | %.2f | %.2f |\n", what, aligned ? ", then aligned" : "",
                cost(graph, s.T_map_node, s.weight), median(off), rms(off),
                *std::max_element(off.begin(), off.end()));
  }
}

int run(int argc, char** argv) {
  if (argc != 2) return std::fputs("usage: bench_gnss GNSS\n", stderr), 2;
  const std::filesystem::path folder = argv[1];
  std::puts(
      "| set | aligner | yaw [deg] | sigma yaw | horizontal median [m] | rms | max | vertical "
      "median "
      "| outliers | effective fixes |\n|---|---|---:|---:|---:|---:|---:|---:|---:|---:|");
  const auto hdl = folder / "graph_iac_gnss/graph.g2o";
  for (const auto& [name, mission] : {std::pair{"race track, 6.5 km", race_track(folder)},
                                      std::pair{"Munich, 4.1 km", munich(folder)},
                                      std::pair{"hdl_graph_slam, 2.4 km", hdl_from_edges(hdl)}})
    for (const char* plugin : {"similarity_4dof", "gnss_trajectory"}) row(name, plugin, mission);
  std::puts("\n| hdl_graph_slam graph | F | median [m] | rms | max |\n|---|---:|---:|---:|---:|");
  const Mission graph = read_g2o(hdl);
  Mission edges = graph;
  std::erase_if(edges.edges, [](const Edge& e) { return e.kind == EdgeKind::position; });
  solve("edges alone", edges, graph);
  solve("edges and GNSS priors", graph, graph);
  return 0;
}

}  // namespace
}  // namespace cambium::testing

int main(int argc, char** argv) { return cambium::testing::run(argc, argv); }
