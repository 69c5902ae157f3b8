// SPDX-License-Identifier: BSD-3-Clause
#include "levenberg_marquardt.hpp"

#include "common/costs.hpp"
#include "damping.hpp"

namespace cambium::sparse_lm {
namespace {

using namespace pose_solver;

/// When a step lowered the cost by less than this fraction, H is nearly what it was.
constexpr double little = 0.03;

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

Minimum LevenbergMarquardt::run(const std::vector<SE3>& start, const Weights& weights,
                                const Loss& loss, const Limits& limits, const Context& context) {
  if (equations_.H().blocks() == 0) return {start, 0, true, "nothing moves"};
  Minimum out{start, 0, false, "reached the limit of iterations"};
  Damping damping;
  Progress progress(limits.tolerance);
  double cost = robust_cost(graph_, start, weights, loss);
  bool linearized = false, near = false;
  while (!out.converged && out.iterations < limits.iterations) {
    context.check_cancelled();
    if (!linearized) equations_.linearize(out.T_map_node, weights, loss);
    linearized = true;
    ++out.iterations;
    Eigen::VectorXd step;
    const bool regular = system_.solve(damping.value(), near, step);
    const double predicted = regular ? system_.predicted_decrease(damping.value(), step) : 0;
    auto poses = regular ? equations_.moved(out.T_map_node, step) : out.T_map_node;
    const double decrease = regular ? cost - robust_cost(graph_, poses, weights, loss) : -1;
    if (decrease > 0) {
      damping.relax(decrease / predicted);
      out.T_map_node = std::move(poses);
      cost -= decrease;
      out.converged = progress.done(decrease, cost);
      near = decrease < little * cost;
      linearized = false;
    } else if (regular && predicted <= limits.tolerance * cost) {
      out.converged = true;  // what is left is rounding
    } else if (!damping.tighten()) {
      out.message = "no step lowers the cost";
      break;
    }
  }
  if (out.converged) out.message = "the cost changes no more";
  return out;
}

}  // namespace cambium::sparse_lm
