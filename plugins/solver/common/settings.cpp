// SPDX-License-Identifier: BSD-3-Clause
#include "common/settings.hpp"

namespace cambium::pose_solver {

void Settings::params(ParamVisitor& v) {
  auto losses = loss_names();
  losses.push_back("gnc");
  v("loss", loss,
    "Robust loss on loops and positions; `none` trusts all of them, `gnc` (graduated "
    "non-convexity) keeps each or drops it",
    one_of(losses));
  v("loss_width", loss_width, "Residuals above this many sigmas count as suspicious",
    above(0.0, "sigma"));
  v("initialization", initialization,
    "`chordal` starts from the given poses or the chordal relaxation, whichever costs less; "
    "`given` "
    "lets both run a few iterations before it compares; `local` knows the given poses only",
    one_of({"chordal", "given", "local"}));
  v("max_iterations", limits.iterations, "Gives up after this many", between(1, 100000));
  v("tolerance", limits.tolerance, "Stops when a step lowers the cost by less than this fraction",
    above(0.0));
  v("diagnostics", diagnostics,
    "Report the gradient and the condition of the normal equations, for one more factorisation");
  v("certify", certify,
    "Say whether the solution is proven to be the global optimum, or by how much the proof fails");
  v("odometry", odometry,
    "`calibrated` takes from the loops how uncertain each mission's odometry is; its file says "
    "only how translations compare with one another, and rotations",
    one_of({"as_given", "calibrated"}));
}

}  // namespace cambium::pose_solver
