// SPDX-License-Identifier: BSD-3-Clause
// How often place recognisers are right, side by side:
//   bench_recognizers SCENE... -- METHOD...
// SCENE is QUERY,REFERENCE (mission folders with ground_truth.tum, one frame for both) or MISSION,K
// (every K-th node is the reference). METHOD is a recogniser with parameters, behind filters if
// any: 'scan_context{rings: 10}' 'stable_normals{} | scan_context_pp'. One row of a Markdown table
// each.
#include <algorithm>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <limits>
#include <map>

#include "recognizer_data.hpp"

namespace {

using namespace cambium;
using bench::Scene;

constexpr double farthest = 30.0;  // queries without a reference within so many metres do not count

double cpu_milliseconds() { return 1e3 * double(std::clock()) / CLOCKS_PER_SEC; }

struct Result {
  std::size_t queries = 0;  ///< that have a reference
  std::size_t first_right = 0, five_right = 0;
  std::vector<double> right_scores, wrong_scores;  ///< of the first candidates
  std::vector<double> translation, rotation;       ///< errors of the right ones' guesses [m], [deg]
  std::size_t good_guesses = 0;  ///< of all first candidates, also those too far along the path
};

void judge_guess(const Scene& scene, const Candidate& c, bool right, Result& result) {
  if (!c.T_reference_query) return;
  const SE3 truth = scene.reference[c.reference].inverse() * scene.query[c.query];
  const SE3 error = truth.inverse() * *c.T_reference_query;
  const double translation = (c.T_reference_query->t - truth.t).head<2>().norm();
  const double rotation = rotation_angle(error) * 57.29578;
  result.good_guesses += translation < 1 && rotation < 5;
  if (!right) return;
  result.translation.push_back(translation);
  result.rotation.push_back(rotation);
}

Result judge(const Scene& scene, const std::vector<Candidate>& candidates) {
  Result result;
  for (std::size_t q = 0; q < scene.query.size(); ++q) {
    if (scene.nearest(q) > farthest) continue;
    ++result.queries;
    std::size_t rank = 0;
    bool within_five = false;
    for (const Candidate& c : candidates) {
      if (c.query != q || rank == 5) continue;
      const bool right = scene.is_right(c);
      within_five |= right;
      if (rank++ > 0) continue;
      (right ? result.right_scores : result.wrong_scores).push_back(c.score);
      result.first_right += right;
      judge_guess(scene, c, right, result);
    }
    result.five_right += within_five;
  }
  return result;
}

/// Of the queries, those whose first candidate is right and scores above every wrong first one.
std::size_t without_error(const Result& result) {
  const double wrong = result.wrong_scores.empty() ? -1e9
                                                   : *std::max_element(result.wrong_scores.begin(),
                                                                       result.wrong_scores.end());
  return std::size_t(std::count_if(result.right_scores.begin(), result.right_scores.end(),
                                   [&](double score) { return score > wrong; }));
}

double middle(std::vector<double> values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::nth_element(values.begin(), values.begin() + long(values.size() / 2), values.end());
  return values[values.size() / 2];
}

void print_row(const Scene& scene, const std::string& method, const std::string& recognizer,
               const Context& context) {
  const auto [name, yaml] = bench::name_and_params(recognizer);
  const auto component = cambium::testing::component<PlaceRecognizer>(name, yaml);
  const double start = cpu_milliseconds();
  const Fingerprints query = component->describe({scene.atlas, 1}, context);
  const Fingerprints reference = component->describe({scene.atlas, 0}, context);
  const double described = cpu_milliseconds();
  const auto candidates = component->match(query, reference, {}, context);
  const double matched = cpu_milliseconds();
  const Result r = judge(scene, candidates);
  const auto percent = [&](std::size_t n) { return 100.0 * double(n) / double(r.queries); };
  std::printf("| %s | `%s` | %zu | %.0f | %.0f | %.0f | %.1f m, %.1f deg | %.0f | %.2f | %.2f |\n",
              scene.name.c_str(), method.c_str(), r.queries, percent(r.first_right),
              percent(r.five_right), percent(without_error(r)), middle(r.translation),
              middle(r.rotation), percent(r.good_guesses),
              (described - start) / double(query.rows + reference.rows),
              1e3 * (matched - described) / double(query.rows * reference.rows));
  std::fflush(stdout);
}

/// "FILTER | FILTER | RECOGNISER" apart.
std::vector<std::string> parts(const std::string& method) {
  std::vector<std::string> out;
  std::size_t from = 0;
  for (std::size_t bar; (bar = method.find(" | ", from)) != std::string::npos; from = bar + 3)
    out.push_back(method.substr(from, bar - from));
  out.push_back(method.substr(from));
  return out;
}

void rows(const std::string& what, int count, char** methods, const Context& context) {
  std::map<std::string, Scene> scenes = {{"", bench::load_scene(what, context)}};  // by filters
  for (int i = 0; i < count; ++i) {
    std::string filters;
    const auto chain = parts(methods[i]);
    for (std::size_t f = 0; f + 1 < chain.size(); ++f) {
      const Scene& before = scenes.at(filters);
      filters += chain[f] + " | ";
      if (!scenes.contains(filters)) scenes[filters] = bench::filtered(before, chain[f], context);
    }
    print_row(scenes.at(filters), methods[i], chain.back(), context);
  }
}

}  // namespace

int main(int argc, char** argv) try {
  char** const bar = std::find_if(argv, argv + argc, [](char* a) { return !std::strcmp(a, "--"); });
  if (bar == argv + 1 || bar + 1 >= argv + argc) {
    std::fprintf(stderr, "usage: bench_recognizers SCENE... -- METHOD...\n");
    return 2;
  }
  const auto context = cambium::testing::make_context();
  std::printf(
      "| scene | method | queries | R@1 [%%] | R@5 | R@1 at 100 %% precision | guess (median) | "
      "1 m, 5 deg [%%] | describe [ms/scan] | match [us/pair] "
      "|\n|---|---|---|---|---|---|---|---|---|---|\n");
  for (char** scene = argv + 1; scene != bar; ++scene)
    rows(*scene, int(argv + argc - bar - 1), bar + 1, *context);
} catch (const std::exception& e) {
  std::fprintf(stderr, "%s\n", e.what());
  return 1;
}
