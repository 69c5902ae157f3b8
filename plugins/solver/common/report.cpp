// SPDX-License-Identifier: BSD-3-Clause
#include "common/report.hpp"

#include <fmt/format.h>

#include "cambium/error.hpp"
#include "common/certificate.hpp"
#include "common/cholesky.hpp"
#include "common/costs.hpp"
#include "common/normal_equations.hpp"

namespace cambium::pose_solver {
namespace {

/// The diagonal block of H^-1: H is the information of the poses when the information matrices of
/// the factors are honest. A held node has no uncertainty.
Mat6 marginal(const NormalEquations& equations, const Cholesky& cholesky, std::size_t node) {
  const int place = equations.elimination().place(node);
  if (place < 0) return Mat6::Zero();
  Eigen::MatrixXd unit = Eigen::MatrixXd::Zero(6 * equations.H().blocks(), 6);
  unit.middleRows<6>(6 * place).setIdentity();
  const Eigen::MatrixXd columns = cholesky.solve(unit);
  const Block S = columns.middleRows<6>(6 * place);
  return 0.5 * (S + S.transpose());
}

}  // namespace

std::vector<double> final_weights(const PoseGraph& graph, const std::vector<SE3>& T_map_node,
                                  const Weights& weights, const Loss& loss) {
  std::vector<double> out = weights.relative;
  for (std::size_t k = 0; k < out.size(); ++k)
    if (const auto& f = graph.relative[k]; f.robust)
      out[k] *= loss.weight(squared_residual(f, T_map_node));
  return out;
}

void report_equations(const Problem& problem, const Weights& weights, const Loss& loss,
                      bool diagnostics, Solution& solution) {
  const PoseGraph& graph = problem.graph;
  NormalEquations equations(graph, problem.elimination);
  if (equations.H().blocks() == 0) {
    solution.marginals.assign(graph.marginals.size(), Mat6::Zero());
    return;
  }
  equations.linearize(solution.T_map_node, weights, loss);
  Cholesky cholesky(problem.elimination, 6, equations.H().pattern());
  const bool regular = cholesky.factorize(equations.H().values().data());
  if (diagnostics) {
    solution.scores.emplace_back("gradient_norm", 2 * equations.g().norm());
    solution.scores.emplace_back("condition", regular ? cholesky.condition() : INFINITY);
  }
  for (const std::size_t node : graph.marginals) {
    if (!regular)
      throw Error(ErrorCode::numeric, fmt::format("node {}", graph.ids.at(node)),
                  "has no marginal covariance: the factors leave a direction of the graph free");
    solution.marginals.push_back(marginal(equations, cholesky, node));
  }
}

void report_odometry(const std::vector<OdometryGroup>& groups, const PoseGraph& graph,
                     const Context& context, Solution& solution) {
  const auto report = [&](const OdometryGroup& group, const char* kind, const SigmaScale& scale) {
    const NodeId node = graph.ids.at(group.first_node);
    if (scale.known)
      solution.scores.emplace_back(fmt::format("odometry.{}.{}", node, kind), scale.factor);
    else
      context.warn(
          fmt::format("the {} of the odometry that begins at node {} is as uncertain as the last "
                      "estimate or the file says: too few loops tell",
                      kind, node));
  };
  for (const OdometryGroup& group : groups) {
    report(group, "translation", group.translation);
    report(group, "rotation", group.rotation);
  }
}

void report_certificate(const PoseGraph& graph, const Weights& weights, const Loss& loss,
                        const Context& context, Solution& solution) {
  Certificate c;
  if (loss.robust())
    c.not_applicable = "the robust loss is not quadratic (`none` and `gnc` are)";
  else
    c = certify(graph, solution.T_map_node, weights.relative);
  if (!c.not_applicable.empty()) {
    context.warn("no certificate of optimality: " + c.not_applicable);
    return;
  }
  solution.scores.emplace_back("certified", c.certified);
  solution.scores.emplace_back("certificate.smallest_eigenvalue", c.smallest_eigenvalue);
  if (!c.certified)
    context.warn(
        fmt::format("the solution is not certified as the global optimum: the smallest "
                    "eigenvalue of the certificate is {:.2g} of its scale, expected {:.0e} "
                    "or more; try another initialization",
                    c.smallest_eigenvalue, -certificate_tolerance));
}

}  // namespace cambium::pose_solver
