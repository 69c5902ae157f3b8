// SPDX-License-Identifier: BSD-3-Clause
#include "matrix/mann_whitney.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace cambium::matrix {
namespace {

// How often a value of `a` is above one of `b`; ties count half.
double u_statistic(const std::vector<double>& a, const std::vector<double>& b) {
  double u = 0;
  for (const double x : a)
    for (const double y : b) u += x > y ? 1 : x == y ? 0.5 : 0;
  return u;
}

// ways[u] = number of orders of n + m values with statistic u. The largest value is either of the
// first sample, and then above all m, or of the second: ways(n, m, u) = ways(n-1, m, u-m) +
// ways(n, m-1, u).
std::vector<double> arrangements(std::size_t n, std::size_t m) {
  std::vector<std::vector<double>> row(m + 1);  // row[j] = ways(i, j, .) for the current i
  for (auto& ways : row) ways = {1};
  for (std::size_t i = 1; i <= n; ++i) {
    row[0] = {1};
    for (std::size_t j = 1; j <= m; ++j) {
      std::vector<double> ways(i * j + 1, 0);
      for (std::size_t u = 0; u < row[j].size(); ++u) ways[u + j] += row[j][u];
      for (std::size_t u = 0; u < row[j - 1].size(); ++u) ways[u] += row[j - 1][u];
      row[j] = std::move(ways);
    }
  }
  return row[m];
}

double exact_p(double u, std::size_t n, std::size_t m) {
  const auto ways = arrangements(n, m);
  double all = 0, extreme = 0;
  const double low = std::min(u, double(n * m) - u);
  for (std::size_t k = 0; k < ways.size(); ++k) {
    all += ways[k];
    if (double(k) <= low) extreme += ways[k];
  }
  return std::min(1.0, 2 * extreme / all);
}

double approximate_p(double u, double n, double m, const std::map<double, int>& counts) {
  const double total = n + m;
  double ties = 0;
  for (const auto& [value, t] : counts) ties += std::pow(t, 3) - t;
  const double variance = n * m / 12 * (total + 1 - ties / (total * (total - 1)));
  if (!(variance > 0)) return 1;  // all values are equal
  const double z = std::max(0.0, std::abs(u - n * m / 2) - 0.5) / std::sqrt(variance);
  return std::erfc(z / std::sqrt(2.0));
}

}  // namespace

double mann_whitney_p(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.empty() || b.empty()) return 1;
  std::map<double, int> counts;
  for (const double x : a) ++counts[x];
  for (const double x : b) ++counts[x];
  const double u = u_statistic(a, b);
  const bool tied = counts.size() < a.size() + b.size();
  return tied || a.size() + b.size() > 60
             ? approximate_p(u, double(a.size()), double(b.size()), counts)
             : exact_p(u, a.size(), b.size());
}

}  // namespace cambium::matrix
