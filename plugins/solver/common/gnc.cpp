// SPDX-License-Identifier: BSD-3-Clause
#include "common/gnc.hpp"

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>

#include "common/costs.hpp"

namespace cambium::pose_solver {
namespace {

constexpr double mu_step = 1.4;      ///< as in the paper
constexpr int inner_iterations = 2;  ///< the next surrogate moves the minimum anyway
constexpr double last_mu = 1e12;     ///< the surrogate is the truncation itself

/// A robust factor's squared residual and the limit above which it is an outlier.
struct Suspect {
  double* weight;
  double squared, limit;
};

double chi_square_limit(int dimensions, double width) {
  return boost::math::quantile(boost::math::chi_squared(dimensions),
                               std::erf(width / std::sqrt(2.0)));
}

std::vector<Suspect> suspects(const PoseGraph& graph, const std::vector<SE3>& poses, double width,
                              Weights& weights) {
  std::vector<Suspect> out;
  const double limit6 = chi_square_limit(6, width), limit3 = chi_square_limit(3, width);
  for (std::size_t k = 0; k < graph.relative.size(); ++k)
    if (const auto& f = graph.relative[k]; f.robust)
      out.push_back({&weights.relative[k], squared_residual(f, poses), limit6});
  for (std::size_t k = 0; k < graph.positions.size(); ++k)
    if (const auto& f = graph.positions[k]; f.robust)
      out.push_back({&weights.positions[k], squared_residual(f, poses), limit3});
  return out;
}

/// Equation (14) of the paper.
double weight(const Suspect& s, double mu) {
  if (s.squared >= (mu + 1) / mu * s.limit) return 0;
  if (s.squared <= mu / (mu + 1) * s.limit) return 1;
  return std::sqrt(s.limit * mu * (mu + 1) / s.squared) - mu;
}

/// Sets the weights; whether every one is 0 or 1.
bool reweigh(const std::vector<Suspect>& all, double mu) {
  bool settled = true;
  for (const Suspect& s : all) {
    *s.weight = weight(s, mu);
    settled = settled && (*s.weight == 0 || *s.weight == 1);
  }
  return settled;
}

/// Nothing suspicious: the last, so that one full run over all factors settles it.
double first_mu(const std::vector<Suspect>& all) {
  double mu = last_mu;
  for (const Suspect& s : all)
    if (2 * s.squared > s.limit) mu = std::min(mu, s.limit / (2 * s.squared - s.limit));
  return mu;
}

}  // namespace

GncResult graduate(Minimizer& minimizer, const PoseGraph& graph, const std::vector<SE3>& start,
                   double width, const Limits& limits, const Context& context) {
  GncResult out{{start, 0, false, ""}, unit_weights(graph)};
  const Loss none;
  int iterations = 0;
  auto all = suspects(graph, start, width, out.weights);
  for (double mu = first_mu(all); mu <= last_mu; mu *= mu_step) {
    context.check_cancelled();
    const bool settled = reweigh(all, mu);
    out.minimum =
        minimizer.run(out.minimum.T_map_node, out.weights, none,
                      settled ? limits : Limits{inner_iterations, limits.tolerance}, context);
    iterations += out.minimum.iterations;
    if (settled) break;
    all = suspects(graph, out.minimum.T_map_node, width, out.weights);
  }
  out.minimum.iterations = iterations;
  return out;
}

}  // namespace cambium::pose_solver
