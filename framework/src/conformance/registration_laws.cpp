// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <Eigen/Eigenvalues>

#include "conformance/law.hpp"

namespace cambium::conformance {
namespace {

void check(const Alignment& a) {
  require(a.T_target_source.finite(), "the transform is not finite");
  if (!a.converged) return require(!a.reason.empty(), "did not converge, and gives no reason");
  require(a.information.allFinite(), "converged with information that is not finite");
  require((a.information - a.information.transpose()).cwiseAbs().maxCoeff() <=
              1e-9 * a.information.cwiseAbs().maxCoeff(),
          "converged with information that is not symmetric");
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> eigen(a.information);
  require(eigen.eigenvalues().minCoeff() > 0,
          fmt::format("converged with information whose smallest eigenvalue is {:.3g}; expected a "
                      "positive definite matrix, with weak directions small but not zero",
                      eigen.eigenvalues().minCoeff()));
  for (const auto& [name, value] : a.scores)
    require(std::isfinite(value), fmt::format("the score '{}' is not finite", name));
}

Alignment align(const Subject& s, const Payload& target, const Payload& source, const SE3& guess,
                const Context& context) {
  const auto& registration = s.as<Registration>();
  const Alignment a = registration.align(registration.prepare(target, context),
                                         registration.prepare(source, context), guess, context);
  check(a);
  return a;
}

Payload moved(const SE3& T, const Payload& p) {
  std::vector<Tree> trees = *p.trees;
  for (Tree& t : trees) t.base = T * t.base, t.axis = T.q * t.axis;
  return {std::make_shared<const Cloud>(transformed(T, *p.cloud)),
          std::make_shared<const std::vector<Tree>>(std::move(trees))};
}

// align(T * A, A) = T, from a guess that is off by 0.3 m and 2 degrees.
void recovers_a_motion(const Subject& s) {
  const Host host(1);
  const auto context = host.context();
  const Payload a = s.world.atlas.payload({0, 2});
  const SE3 T = SE3::from_yaw(0.7, {2.0, -1.0, 0.2});
  const SE3 guess = T * SE3::from_yaw(0.035, {0.25, -0.15, 0.05});
  const Alignment found = align(s, moved(T, a), a, guess, *context);
  require(found.converged, "a payload and its moved copy do not converge: " + found.reason);
  const SE3 error = T.inverse() * found.T_target_source;
  require(
      error.t.norm() < 0.05 && rotation_angle(error) < 0.01,
      fmt::format("align(T A, A) is off T by {:.3f} m and {:.4f} rad; expected less than 0.05 m "
                  "and 0.01 rad",
                  error.t.norm(), rotation_angle(error)));
}

void refuses_strange_guess(const Subject& s) {
  const Host host(1);
  SE3 guess;
  guess.t.x() = std::numeric_limits<double>::quiet_NaN();
  const Payload a = s.world.atlas.payload({0, 2});
  const auto& registration = s.as<Registration>();
  const auto context = host.context();
  const Alignment found = registration.align(registration.prepare(a, *context),
                                             registration.prepare(a, *context), guess, *context);
  if (found.converged)
    require(found.T_target_source.finite(), "a guess of NaN went into the result");
}

}  // namespace

Exercise exercise_registration(const Subject& s) {
  const NodeRef target{0, 2}, source{0, 3};
  const auto run = [&s, target, source](const Payload& a, const Payload& b, const Context& c) {
    return encode(align(s, a, b, s.world.T_target_source(target, source), c));
  };
  const Payload a = s.world.atlas.payload(target), b = s.world.atlas.payload(source);
  Exercise e;
  e.usual = [run, a, b](const Context& c) { return run(a, b, c); };
  for (const OddPayload& odd : odd_payloads()) {
    e.odd.emplace_back(odd.name + " as the target",
                       [run, b, odd](const Context& c) { return run(odd.payload, b, c); });
    e.odd.emplace_back(odd.name + " as the source",
                       [run, a, odd](const Context& c) { return run(a, odd.payload, c); });
  }
  e.own = {{"recovers the motion of a moved copy", recovers_a_motion},
           {"bears a guess that is not finite", refuses_strange_guess}};
  return e;
}

}  // namespace cambium::conformance
