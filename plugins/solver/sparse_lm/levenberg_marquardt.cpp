// SPDX-License-Identifier: BSD-3-Clause
#include "levenberg_marquardt.hpp"

#include <algorithm>

#include "damping.hpp"
#include "model.hpp"

namespace cambium::sparse_lm {
namespace {

using namespace pose_solver;

/// When a step lowered the cost by less than this fraction, H is nearly what it was.
constexpr double little = 0.03;

/// A structure for more factors than there are costs fill; a new one costs an ordering. Without the
/// last 2 % of 1000 false loops a factorisation of sphere2500 takes half the time.
constexpr double enough_of_them = 0.97;

/// Whether the cost will not fall by `tolerance` any more. Near the minimum the decreases shrink
/// geometrically at least, so the last two tell the sum of those to come.
class Progress {
 public:
  explicit Progress(double tolerance) : tolerance_(tolerance) {}
  bool done(double decrease, double cost) {
    const double ratio = decrease / last_;
    last_ = decrease;
    const double to_come = ratio < 0.5 ? decrease * ratio / (1 - ratio) : decrease;
    return to_come <= tolerance_ * cost;
  }

 private:
  double tolerance_, last_ = 0;
};

}  // namespace

LevenbergMarquardt::Structure::Structure(const Problem& problem, std::vector<bool> used)
    : use(std::move(used)),
      own(std::count(use.begin(), use.end(), false) == 0
              ? nullptr
              : std::make_unique<Elimination>(problem.graph, problem.held, use)),
      equations(problem.graph, own ? *own : problem.elimination),
      system(equations) {}

LevenbergMarquardt::Structure& LevenbergMarquardt::structure_for(const Weights& weights) {
  std::vector<bool> wanted(weights.relative.size());
  for (std::size_t k = 0; k < wanted.size(); ++k) wanted[k] = weights.relative[k] != 0;
  if (structure_) {
    const auto& use = structure_->use;
    bool covers = true;
    for (std::size_t k = 0; k < use.size(); ++k) covers = covers && (use[k] || !wanted[k]);
    const auto count = [](const auto& list) {
      return double(std::count(list.begin(), list.end(), true));
    };
    if (covers && count(wanted) >= enough_of_them * count(use)) return *structure_;
  }
  structure_ = std::make_unique<Structure>(problem_, std::move(wanted));
  return *structure_;
}

Minimum LevenbergMarquardt::run(const std::vector<SE3>& start, const Weights& weights,
                                const Loss& loss, const Limits& limits, const Context& context) {
  if (problem_.elimination.count() == 0) return {start, 0, true, "nothing moves"};
  auto& [use, own, equations, system] = structure_for(weights);
  Model model(problem_.graph, equations, weights, loss);
  State now{start, unit_weights(problem_.graph)};
  Minimum out{{}, 0, false, "reached the limit of iterations", model.cost(now)};
  Damping damping;
  Progress progress(limits.tolerance);
  // After a factorisation this is a run of many, each near the last one.
  bool linearized = false, near = system.factored();
  while (!out.converged && out.iterations < limits.iterations) {
    context.check_cancelled();
    if (!linearized) model.linearize(now);
    linearized = true;
    ++out.iterations;
    Eigen::VectorXd step;
    const bool regular = system.solve(damping.value(), near, step);
    const double predicted =
        regular ? system.predicted_decrease(damping.value(), step) + model.gain_of_switches(now)
                : 0;
    State next = regular ? model.moved(now, step) : now;
    const double decrease = regular ? out.cost - model.cost(next) : -1;
    if (decrease > 0) {
      damping.relax(decrease / predicted);
      now = std::move(next);
      out.cost -= decrease;
      out.converged = progress.done(decrease, out.cost);
      near = decrease < little * out.cost;
      linearized = false;
    } else if (regular && predicted <= limits.tolerance * out.cost) {
      out.converged = true;  // what is left is rounding
    } else if (!damping.tighten()) {
      out.message = "no step lowers the cost";
      break;
    }
  }
  if (out.converged) out.message = "the cost changes no more";
  out.T_map_node = std::move(now.T_map_node);
  return out;
}

}  // namespace cambium::sparse_lm
