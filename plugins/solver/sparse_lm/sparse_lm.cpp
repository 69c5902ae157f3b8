// SPDX-License-Identifier: BSD-3-Clause
// Pose-graph optimisation of our own: see README.md.
#include "cambium/plugin.hpp"
#include "common/solve.hpp"
#include "levenberg_marquardt.hpp"

namespace cambium::sparse_lm {
namespace {

class SparseLm final : public Solver {
 public:
  void params(ParamVisitor& v) override { settings_.params(v); }

  Solution solve(const PoseGraph& graph, const Context& context) const override {
    return pose_solver::solve(settings_, graph, context,
                              [](const PoseGraph& checked, const std::vector<bool>& held) {
                                return std::make_unique<LevenbergMarquardt>(checked, held);
                              });
  }

 private:
  pose_solver::Settings settings_;
};

}  // namespace
}  // namespace cambium::sparse_lm

CAMBIUM_PLUGIN("sparse_lm", "0.1.0") {
  registry.add<cambium::sparse_lm::SparseLm>(
      "sparse_lm", "Levenberg-Marquardt made for pose graphs: block-sparse, supernodal Cholesky");
}
