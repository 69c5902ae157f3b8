// SPDX-License-Identifier: BSD-3-Clause
// How long scan_context takes to find the ten best of N descriptors of 20 x 60, over all shifts:
//   bench_scan_context [--check Q] N...
// One row for each N and world: one query at a time, a whole mission of queries at once, and that
// every id is the one that the definition gives (for the first queries; by brute force).
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <numeric>

#include "made_up_world.hpp"

namespace {

using namespace cambium;
using bench::World;

constexpr std::size_t queries = 64, singles = 16, rings = 20, sectors = 60, wanted = 10;

double cpu_milliseconds() { return 1e3 * double(std::clock()) / CLOCKS_PER_SEC; }

Fingerprints describe(const PlaceRecognizer& recognizer, Mission mission, const Context& context) {
  return recognizer.describe({cambium::testing::make_atlas({std::move(mission)}), 0}, context);
}

/// d(r) of the definition, for rows without an empty column or with.
double distance(std::span<const float> q, std::span<const float> r) {
  bool filled_q[sectors] = {}, filled_r[sectors] = {};
  for (std::size_t i = 0; i < rings * sectors; ++i)
    filled_q[i / rings] |= q[i] != 0, filled_r[i / rings] |= r[i] != 0;
  double best = 1;
  for (std::size_t k = 0; k < sectors; ++k) {
    double sum = 0;
    int n = 0;
    for (std::size_t s = 0; s < sectors; ++s) {
      const std::size_t t = (s + k) % sectors;
      double cosine = 0;
      for (std::size_t i = 0; i < rings; ++i)
        cosine += double(q[s * rings + i]) * double(r[t * rings + i]);
      sum += cosine;
      n += filled_q[s] && filled_r[t];
    }
    if (n >= 15) best = std::min(best, 1.0 - sum / n);
  }
  return std::max(0.0, best);
}

/// The wanted ids of one query, best first.
std::vector<std::size_t> by_definition(std::span<const float> q, const Fingerprints& reference) {
  std::vector<std::pair<double, std::size_t>> all;
  for (std::size_t r = 0; r < reference.rows; ++r)
    all.push_back({distance(q, reference.row(r)), r});
  std::partial_sort(all.begin(), all.begin() + wanted, all.end());
  std::vector<std::size_t> ids;
  for (std::size_t i = 0; i < wanted; ++i) ids.push_back(all[i].second);
  return ids;
}

std::vector<std::size_t> ids_of(const std::vector<Candidate>& candidates, std::size_t query) {
  std::vector<std::size_t> ids;
  for (const Candidate& c : candidates)
    if (c.query == query) ids.push_back(c.reference);
  return ids;
}

void row(World world, const char* name, std::size_t n, std::size_t checked) {
  const auto context = cambium::testing::make_context();
  const auto recognizer = cambium::testing::component<PlaceRecognizer>(
      "scan_context", "{threshold: 1, candidates: " + std::to_string(wanted) + "}");
  std::vector<std::size_t> path(n);
  std::iota(path.begin(), path.end(), 0);
  const Fingerprints reference =
      describe(*recognizer, bench::made_up_mission(world, "a", path, 0), *context);
  // Every second query was passed by at 3 m, the others are from elsewhere.
  const auto query_mission = [&](std::size_t first, std::size_t count) {
    std::vector<std::size_t> steps;
    for (std::size_t q = first; q < first + count; ++q)
      steps.push_back(q % 2 ? 2 * n + 1000 * q : q * n / queries);
    return bench::made_up_mission(world, "b", steps, 3);
  };
  std::vector<double> single;
  std::vector<std::vector<std::size_t>> found;
  for (std::size_t q = 0; q < singles; ++q) {
    const Fingerprints one = describe(*recognizer, query_mission(q, 1), *context);
    const double start = cpu_milliseconds();
    const auto candidates = recognizer->match(one, reference, {}, *context);
    single.push_back(cpu_milliseconds() - start);
    found.push_back(ids_of(candidates, 0));
  }
  const Fingerprints many = describe(*recognizer, query_mission(0, queries), *context);
  const double start = cpu_milliseconds();
  const auto candidates = recognizer->match(many, reference, {}, *context);
  const double bulk = (cpu_milliseconds() - start) / queries;
  std::size_t same = 0;
  for (std::size_t q = 0; q < checked; ++q) {
    const auto expected = by_definition(many.row(q).first(rings * sectors), reference);
    same += expected == found[q] && expected == ids_of(candidates, q);
  }
  std::sort(single.begin(), single.end());
  std::printf("| %zu | %s | %.2f | %.2f | %.2f | %zu of %zu | %.0f + %.0f |\n", n, name,
              single[single.size() / 2], single.back(), bulk, same, checked,
              1e-6 * double(reference.table.size() * sizeof(float)),
              1e-6 * double(reference.extra.size()));
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) try {
  const bool says = argc > 2 && std::string(argv[1]) == "--check";
  const std::size_t checked = says ? std::stoul(argv[2]) : 4;
  if (argc < (says ? 4 : 2) || checked > singles) {
    std::fprintf(stderr, "usage: bench_scan_context [--check Q] N...   (Q <= %zu)\n", singles);
    return 2;
  }
  std::printf(
      "| descriptors | world | one query: median [ms] | slowest | each of %zu at once [ms] | "
      "ids as by brute force | memory [MB] |\n|---|---|---|---|---|---|---|\n",
      queries);
  for (int i = says ? 3 : 1; i < argc; ++i) {
    const std::size_t n = std::stoul(argv[i]);
    row(World::town, "town", n, checked);
    if (n <= 100000) row(World::alike, "alike", n, checked);
  }
} catch (const std::exception& e) {
  std::fprintf(stderr, "%s\n", e.what());
  return 1;
}
