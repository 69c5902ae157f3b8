// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cstdio>
#include <optional>

#include "bench/registration_tally.hpp"
#include "bench/scans.hpp"
#include "support/support.hpp"

namespace cambium::bench {
namespace {

using testing::component;
using testing::make_context;

// Consecutive scans of the courtyard are 5 m apart, so its start is the truth moved by half a metre
// and three degrees; those of the car are 1.2 m apart and start at the identity.
SE3 start(const SE3& truth, bool courtyard) {
  Vec6 error;
  error << 0.3, -0.3, 0.1, 0.01, -0.01, 0.05;
  return courtyard ? truth * SE3::exp(error) : SE3{};
}

struct Chain {
  std::vector<SE3> T;                         ///< T_i_(i+step)
  std::vector<double> aligned;                ///< [ms]
  std::vector<double> translation, rotation;  ///< errors against the truth
};

Chain chain(const Registration& method, const PreparedScans& s, std::size_t step, bool courtyard) {
  Chain out;
  const auto context = make_context();
  for (std::size_t i = 0; i + step < s.scans.size(); ++i) {
    const SE3 truth = s.scans[i].T_world_base.inverse() * s.scans[i + step].T_world_base;
    const double begin = cpu_milliseconds();
    out.T.push_back(
        method.align(s.prepared[i], s.prepared[i + step], start(truth, courtyard), *context)
            .T_target_source);
    out.aligned.push_back(cpu_milliseconds() - begin);
    const SE3 error = truth.inverse() * out.T.back();
    out.translation.push_back(error.t.norm());
    out.rotation.push_back(rotation_angle(error) / degree);
  }
  return out;
}

void consecutive(const Registration& method, const std::string& name, std::vector<Scan> scans,
                 bool courtyard) {
  if (scans.empty()) return;
  const PreparedScans s = prepare(method, std::move(scans));
  const Chain one = chain(method, s, 1, courtyard), two = chain(method, s, 2, courtyard);
  std::vector<double> translation, rotation;
  for (std::size_t i = 0; i < two.T.size(); ++i) {
    const SE3 open = two.T[i].inverse() * one.T[i] * one.T[i + 1];
    translation.push_back(open.t.norm());
    rotation.push_back(rotation_angle(open) / degree);
  }
  const double prepared = median(s.milliseconds), aligned = median(one.aligned);
  std::printf("| %-9s | gicp | %5.1f | %5.1f | %5.1f | %.3f m %.2f deg | %.4f m %.3f deg |\n",
              name.c_str(), prepared, aligned, 2 * prepared + aligned, median(one.translation),
              median(one.rotation), median(translation), median(rotation));
}

using Found = std::vector<std::vector<std::optional<SE3>>>;  ///< T_a_b by index of a and b

// The truth's attitudes err by a degree, so the pairs are also judged by one another: a ring of
// four pairs leads back to where it began when all four are right.
void print_rings(const Found& found) {
  std::vector<double> open;
  int wide = 0;
  for (std::size_t i = 0; i + 1 < found.size(); ++i)
    for (std::size_t j = 0; j + 1 < found[i].size(); ++j) {
      const auto &a = found[i][j], &b = found[i + 1][j], &c = found[i + 1][j + 1],
                 &d = found[i][j + 1];
      if (!a || !b || !c || !d) continue;
      open.push_back((*a * b->inverse() * *c * d->inverse()).t.norm());
      wide += open.back() > 0.5;
    }
  std::sort(open.begin(), open.end());
  std::printf(
      "rings of four pairs: %zu, open by %.3f m (median), %.3f m (99 %%), %d by more than 0.5 "
      "m\n\n",
      open.size(), median(open), open[open.size() * 99 / 100], wide);
}

}  // namespace

PreparedScans prepare(const Registration& method, std::vector<Scan> scans) {
  PreparedScans out{std::move(scans), {}, {}};
  for (const Scan& scan : out.scans) {
    const double begin = cpu_milliseconds();
    out.prepared.push_back(method.prepare(scan.payload, *make_context()));
    out.milliseconds.push_back(cpu_milliseconds() - begin);
  }
  return out;
}

void global_table(const std::string& yaml) {
  const auto method = component<Registration>("global_registration", yaml);
  const PreparedScans a = prepare(*method, newer_college("mission_a")),
                      b = prepare(*method, newer_college("mission_b"));
  if (a.scans.empty()) return;
  constexpr std::array limits{5.0, 10.0, 15.0, 20.0, 25.0, 30.0};
  std::array<Tally, limits.size() + 1> tallies;
  std::vector<double> in_all;
  Found found(a.scans.size(), std::vector<std::optional<SE3>>(b.scans.size()));
  for (std::size_t i = 0; i < a.scans.size(); ++i)
    for (std::size_t j = 0; j < b.scans.size(); ++j) {
      const SE3 truth = a.scans[i].T_world_base.inverse() * b.scans[j].T_world_base;
      const auto bin = std::upper_bound(limits.begin(), limits.end(), truth.t.norm());
      const double begin = cpu_milliseconds();
      const Alignment one = method->align(a.prepared[i], b.prepared[j], SE3{}, *make_context());
      const double ms = cpu_milliseconds() - begin;
      tallies[std::size_t(bin - limits.begin())].add(one, truth, ms);
      const bool near = bin != limits.end();  // farther pairs may be refused
      if (near) in_all.push_back(ms + a.milliseconds[i] + b.milliseconds[j]);
      if (near || one.converged) found[i][j] = one.T_target_source;
    }
  std::printf("global_registration %s, no guess\n", yaml.c_str());
  Tally::print_header();
  for (std::size_t k = 0; k < limits.size(); ++k)
    tallies[k].print(std::to_string(int(limits[k]) - 5) + "-" + std::to_string(int(limits[k])) +
                     " m");
  tallies.back().print("over 30 m");
  std::printf("up to 30 m, with preparing both scans: median %.0f ms\n", median(in_all));
  print_rings(found);
}

void consecutive_table() {
  const auto method = component<Registration>(
      "gicp", "{voxel_size: 0.25, search_radius: 0, search_yaw: 0, source_points: 1000000}");
  std::printf(
      "| scans | method | prepare ms | align ms | pair with both prepared ms | error against the "
      "truth | steps of one against steps of two |\n|---|---|---|---|---|---|---|\n");
  consecutive(*method, "courtyard", newer_college("mission_a"), true);
  for (const char* name : {"KAIST03", "Seosan01"}) consecutive(*method, name, mulran(name), false);
  std::printf("\n");
}

}  // namespace cambium::bench
