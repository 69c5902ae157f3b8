// SPDX-License-Identifier: BSD-3-Clause
// How often a place recogniser is right:
//   bench_recognizers QUERY REFERENCE [SCAN_CONTEXT_PARAMS...]
// QUERY and REFERENCE are mission folders with ground_truth.tum (one frame for both). Each further
// argument is a YAML map, e.g. '{rings: 10}'. One row of a Markdown table for each.
#include <algorithm>
#include <cstdio>
#include <ctime>

#include "cambium/files.hpp"
#include "support/support.hpp"

namespace {

using namespace cambium;

std::vector<Vec3> true_positions(const Mission& mission) {
  std::vector<Vec3> out;
  for (const auto& pose : read_tum(mission.folder / "ground_truth.tum"))
    out.push_back(pose.T_map_node.t);
  if (out.size() != mission.nodes.size())
    throw Error(ErrorCode::data, (mission.folder / "ground_truth.tum").string(),
                "expected one pose for each of " + std::to_string(mission.nodes.size()) +
                    " nodes, found " + std::to_string(out.size()));
  return out;
}

struct Scene {
  Atlas atlas;
  std::vector<Vec3> query, reference;  ///< true positions [m]
  double distance(const Candidate& c) const {
    return (query[c.query] - reference[c.reference]).norm();
  }
};

Scene load(const std::string& query, const std::string& reference, const Context& context) {
  const auto reader = cambium::testing::component<MissionReader>("mission_folder");
  Mission q = reader->read(query, context), r = reader->read(reference, context);
  q.name = "b";
  r.name = "a";  // an atlas is ordered by name: the reference comes first
  std::vector<Vec3> at_query = true_positions(q), at_reference = true_positions(r);
  return {cambium::testing::make_atlas({std::move(q), std::move(r)}), at_query, at_reference};
}

/// Of the queries that have a reference within `limit`: the share with one among the first `n`
/// candidates [%].
double recall(const Scene& scene, const std::vector<Candidate>& candidates, std::size_t n,
              double limit) {
  std::size_t possible = 0, found = 0;
  for (std::size_t q = 0; q < scene.query.size(); ++q) {
    possible += std::any_of(scene.reference.begin(), scene.reference.end(),
                            [&](const Vec3& r) { return (scene.query[q] - r).norm() < limit; });
    std::size_t rank = 0;
    bool hit = false;
    for (const Candidate& c : candidates)
      if (c.query == q && rank++ < n) hit = hit || scene.distance(c) < limit;
    found += hit;
  }
  return possible == 0 ? 0.0 : 100.0 * double(found) / double(possible);
}

/// How far scores separate: the lowest score of the first candidates within 5 m, and the highest
/// of any pair more than 10 m apart.
std::pair<double, double> separation(const Scene& scene, const std::vector<Candidate>& candidates) {
  double lowest_right = 1.0, highest_wrong = 0.0;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const Candidate& c = candidates[i];
    const bool first = i == 0 || candidates[i - 1].query != c.query;
    if (first && scene.distance(c) < 5.0) lowest_right = std::min(lowest_right, c.score);
    if (scene.distance(c) > 10.0) highest_wrong = std::max(highest_wrong, c.score);
  }
  return {lowest_right, highest_wrong};
}

double cpu_milliseconds() { return 1e3 * double(std::clock()) / CLOCKS_PER_SEC; }

void print_row(const Scene& scene, const std::string& yaml, const Context& context) {
  const auto recognizer = cambium::testing::component<PlaceRecognizer>("scan_context", yaml);
  const double start = cpu_milliseconds();
  const Fingerprints query = recognizer->describe({scene.atlas, 1}, context);
  const Fingerprints reference = recognizer->describe({scene.atlas, 0}, context);
  const double described = cpu_milliseconds();
  const auto candidates = recognizer->match(query, reference, {}, context);
  const double matched = cpu_milliseconds();
  const auto [right, wrong] = separation(scene, candidates);
  std::printf("| `%s` | %.0f | %.0f | %.0f | %.0f | %.3f | %.3f | %.1f | %.2f |\n", yaml.c_str(),
              recall(scene, candidates, 1, 5), recall(scene, candidates, 5, 5),
              recall(scene, candidates, 1, 10), recall(scene, candidates, 5, 10), right, wrong,
              (described - start) / double(query.rows + reference.rows),
              1e3 * (matched - described) / double(query.rows * reference.rows));
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc < 3) {
    std::fprintf(stderr, "usage: bench_recognizers QUERY REFERENCE [SCAN_CONTEXT_PARAMS...]\n");
    return 2;
  }
  const auto context = cambium::testing::make_context();
  const Scene scene = load(argv[1], argv[2], *context);
  std::printf(
      "| parameters | R@1 5 m [%%] | R@5 5 m | R@1 10 m | R@5 10 m | lowest right | highest wrong "
      "| describe [ms/scan] | match [us/pair] |\n|---|---|---|---|---|---|---|---|---|\n");
  for (int i = 3; i < argc; ++i) print_row(scene, argv[i], *context);
  if (argc == 3) print_row(scene, "{}", *context);
} catch (const std::exception& e) {
  std::fprintf(stderr, "%s\n", e.what());
  return 1;
}
