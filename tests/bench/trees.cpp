// SPDX-License-Identifier: BSD-3-Clause
// How often tree_match is right, and how long it takes:
//   bench_trees evo|venman|simulated [TREE_MATCH_PARAMS]
// The missions of missions_evo or missions_venman (or simulated ones, see tree_data.hpp) against
// each other, and each against its own past (50 m of path and more). A query is right when its
// position in the reference node is within 0.5 m (1.5 m for Venman) of the truth and its rotation
// within 5 degrees: once counted in the horizontal plane, once in space. The baseline is the true
// distance to the nearest node that may be proposed.
#include <algorithm>
#include <cstdio>
#include <map>
#include <numbers>

#include "bench/tree_data.hpp"
#include "cambium/statistics.hpp"

namespace {

using namespace cambium;
using namespace cambium::bench;

struct Tally {
  std::size_t queries = 0, right = 0, right_in_space = 0;
  double percent(std::size_t n) const { return queries ? 100.0 * double(n) / double(queries) : 0; }
  void add(const Tally& other) {
    queries += other.queries, right += other.right, right_in_space += other.right_in_space;
  }
};

struct Result {
  std::map<int, Tally> by_baseline;  ///< first metre of each bin of 5 m; 80 for all beyond
  std::size_t accepted = 0, wrong = 0, far = 0, far_accepted = 0;
  std::vector<double> position, height;  ///< errors of the right ones [m]
  std::vector<double> milliseconds;      ///< of a query
  std::vector<std::string> mistakes;     ///< a line each
};

double baseline(const TreeMission& q, std::size_t i, const TreeMission& r, const Pairing& pairing) {
  double nearest = 1e9;
  for (std::size_t k = 0; k < r.truth.size(); ++k)
    if (pairing.allowed(i, k)) nearest = std::min(nearest, (q.truth[i].t - r.truth[k].t).norm());
  return nearest;
}

std::string mistake(const TreeMission& q, std::size_t i, const TreeMission& r, const Candidate& c,
                    double baseline, const SE3& error) {
  char text[200];
  std::snprintf(
      text, sizeof text,
      "wrong: %s/%zu at %s/%zu, %.1f m from its path: off by %.2f m, %.2f deg; score %.1f",
      q.mission.name.c_str(), i, r.mission.name.c_str(), c.reference, baseline,
      error.t.head<2>().norm(), rotation_angle(error) * 180 / std::numbers::pi, c.score);
  return text;
}

void judge(const TreeMission& q, const TreeMission& r, bool within, double limit,
           const PlaceRecognizer& recognizer, Result& out) {
  constexpr double min_path = 50, far = 80, limit_angle = 5 * std::numbers::pi / 180;
  const StopWatch context;
  const Pairing pairing{within, min_path, q.path, r.path};
  std::map<std::size_t, Candidate> found;
  for (const Candidate& c : recognizer.match(q.fingerprints, r.fingerprints, pairing, context))
    found.emplace(c.query, c);
  out.milliseconds.insert(out.milliseconds.end(), context.milliseconds.begin(),
                          context.milliseconds.end());
  for (std::size_t i = 0; i < q.truth.size(); ++i) {
    const double distance = baseline(q, i, r, pairing);
    if (distance > 1e8) continue;
    const auto it = found.find(i);
    Tally& tally = out.by_baseline[distance > far ? int(far) : 5 * int(distance / 5)];
    ++tally.queries;
    out.far += distance > far;
    if (it == found.end()) continue;
    const SE3 T = r.truth[it->second.reference].inverse() * q.truth[i];
    const SE3 error = T.inverse() * *it->second.T_reference_query;
    const double off = error.t.head<2>().norm();
    const bool right = off < limit && rotation_angle(error) < limit_angle;
    ++out.accepted;
    out.wrong += !right;
    out.far_accepted += distance > far;
    tally.right += right;
    tally.right_in_space += right && error.t.norm() < limit;
    if (!right) out.mistakes.push_back(mistake(q, i, r, it->second, distance, error));
    if (!right) continue;
    out.position.push_back(off);
    out.height.push_back(std::abs(error.t.z()));
  }
}

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  return values[std::size_t(share * double(values.size() - 1))];
}

void row(const char* what, const Tally& t) {
  std::printf("| %s | %zu | %.2f | %.2f |\n", what, t.queries, t.percent(t.right),
              t.percent(t.right_in_space));
}

void print(const std::string& name, const Result& result) {
  std::printf("| %s | queries | right [%%] | in space [%%] |\n|---|---|---|---|\n", name.c_str());
  Tally near;
  for (const auto& [from, tally] : result.by_baseline) {
    if (from < 20) near.add(tally);
    const std::string bin = std::to_string(from) + " to " + std::to_string(from + 5) + " m";
    if (from < 30) row(bin.c_str(), tally);
  }
  row("up to 20 m", near);
  std::printf("\naccepted %zu, of them wrong %zu; farther than 80 m: %zu queries, %zu accepted\n",
              result.accepted, result.wrong, result.far, result.far_accepted);
  for (const std::string& line : result.mistakes) std::printf("%s\n", line.c_str());
  if (result.position.empty()) return;
  std::printf(
      "position error [m]: median %.3f, 95 %% %.3f; height error: median %.3f, 95 %% %.3f\n",
      median(result.position), quantile(result.position, 0.95), median(result.height),
      quantile(result.height, 0.95));
  std::printf("query [ms of processor time]: median %.2f, 95 %% %.2f\n\n",
              median(result.milliseconds), quantile(result.milliseconds, 0.95));
}

/// Another forest, and pieces of the own one that the query is far away from.
Result far_queries(const std::vector<TreeMission>& own, const std::vector<TreeMission>& other,
                   const PlaceRecognizer& recognizer) {
  Result out;
  const auto strangers = far_from(other, 1e6);
  for (const TreeMission& r : own) {
    for (const TreeMission& q : strangers) judge(q, r, false, 0, recognizer, out);
    for (const TreeMission& piece : pieces(r, 100, recognizer))
      for (const auto* set : {&own, &strangers})
        for (const TreeMission& q : *set) judge(q, piece, false, 0, recognizer, out);
  }
  return out;
}

}  // namespace

int main(int argc, char** argv) try {
  const std::string set = argc > 1 ? argv[1] : "";
  if (set != "evo" && set != "venman" && set != "simulated") {
    std::fprintf(stderr, "usage: bench_trees evo|venman|simulated [TREE_MATCH_PARAMS]\n");
    return 2;
  }
  const auto recognizer =
      cambium::testing::component<PlaceRecognizer>("tree_match", argc > 2 ? argv[2] : "{}");
  auto own = set == "simulated" ? std::vector<TreeMission>{}
                                : tree_missions("missions_" + set, *recognizer);
  const bool real = !own.empty();
  if (!real) {
    if (set != "simulated") std::printf("missions_%s is not here: simulated\n", set.c_str());
    own = simulated_missions(1, *recognizer);
  }
  const auto other =
      real ? tree_missions(set == "evo" ? "missions_venman" : "missions_evo", *recognizer)
           : simulated_missions(2, *recognizer);
  Result between, within;
  const double limit = real && set == "venman" ? 1.5 : 0.5;
  for (std::size_t r = 0; r < own.size(); ++r)
    for (std::size_t q = r; q < own.size(); ++q)
      judge(own[q], own[r], q == r, limit, *recognizer, q == r ? within : between);
  print(set + ", between missions", between);
  print(set + ", within missions", within);
  const Result far = far_queries(own, other, *recognizer);
  std::printf(
      "another forest, and pieces of the own one: %zu queries farther than 80 m, %zu accepted\n",
      far.far, far.far_accepted);
} catch (const std::exception& e) {
  std::fprintf(stderr, "%s\n", e.what());
  return 1;
}
