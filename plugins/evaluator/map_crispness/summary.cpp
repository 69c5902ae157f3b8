// SPDX-License-Identifier: BSD-3-Clause
#include "summary.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "cambium/statistics.hpp"

namespace map_crispness {
namespace {

using namespace cambium;

/// A figure of the pairs that have it.
std::vector<double> finite(const std::vector<Agreement>& agreements, double Agreement::*figure) {
  std::vector<double> out;
  for (const Agreement& a : agreements)
    if (std::isfinite(a.*figure)) out.push_back(a.*figure);
  return out;
}

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / double(values.size());
}

/// Medians of distances and the mean entropy, as `<prefix>median`, ...
std::vector<Metric> figures(const std::vector<Agreement>& agreements, const std::string& prefix,
                            Better better) {
  std::vector<Metric> out;
  const auto add = [&](const char* name, double Agreement::*figure) {
    if (const auto values = finite(agreements, figure); !values.empty())
      out.push_back({"map_crispness." + prefix + name, median(values), "m", better});
  };
  add("median", &Agreement::all);
  add("ground", &Agreement::ground);
  add("upright", &Agreement::upright);
  if (const auto entropies = finite(agreements, &Agreement::entropy); !entropies.empty())
    out.push_back({"map_crispness." + prefix + "entropy", mean(entropies), "nat", better});
  return out;
}

}  // namespace

std::vector<Metric> summary(const std::vector<Compared>& compared) {
  std::vector<Agreement> fused, beside_truth, truth;
  double overlap = 0;
  for (const Compared& c : compared) {
    if (!c.fused) continue;
    fused.push_back(*c.fused);
    overlap += c.fused->overlap / double(compared.size());
    if (!c.truth || !std::isfinite(c.fused->all) || !std::isfinite(c.truth->all)) continue;
    beside_truth.push_back(*c.fused);
    truth.push_back(*c.truth);
  }
  const auto distances = finite(fused, &Agreement::all);
  std::vector<Metric> out = figures(fused, "", Better::lower);
  out.push_back({"map_crispness.pairs", double(distances.size()), "pairs", Better::neither});
  if (compared.empty()) return out;
  out.push_back({"map_crispness.overlap", overlap, "", Better::higher});
  if (distances.empty()) return out;
  out.push_back({"map_crispness.worst", *std::max_element(distances.begin(), distances.end()), "m",
                 Better::lower});
  const auto of_truth = figures(truth, "truth.", Better::neither);
  out.insert(out.end(), of_truth.begin(), of_truth.end());
  const auto true_distances = finite(truth, &Agreement::all);
  if (!true_distances.empty() && median(true_distances) > 0)
    out.push_back({"map_crispness.ratio",
                   median(finite(beside_truth, &Agreement::all)) / median(true_distances), "",
                   Better::lower});
  return out;
}

}  // namespace map_crispness
