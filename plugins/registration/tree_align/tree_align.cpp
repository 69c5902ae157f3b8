// SPDX-License-Identifier: BSD-3-Clause
// Registration of two nodes by the stems that both saw, from a guess that is good to about a metre
// (that of tree_match). Position and heading, with an optional correction of the tilt.
#include <Eigen/Eigenvalues>
#include <cmath>

#include "cambium/plugin.hpp"
#include "stems.hpp"

namespace tree_align {

using namespace cambium;

class TreeAlign final : public Registration {
 public:
  void params(ParamVisitor& v) override {
    v("coarse_radius", coarse_radius_, "Stems match within this distance at first",
      above(0.0, "m"));
    v("radius", radius_, "Stems match within this distance in the end", above(0.0, "m"));
    v("max_dbh_difference", max_dbh_difference_, "Of the diameters of two matched stems",
      above(0.0, "m"));
    v("min_matches", min_matches_, "Fewer matched stems are no convergence", between(3, 1000));
    v("max_rmse", max_rmse_, "Largest horizontal residual of the matched stems", above(0.0, "m"));
    v("correct_tilt", correct_tilt_, "Also correct roll and pitch, against gravity as a prior");
    v("sigma_stem", noise_.stem, "Of a stem's horizontal position", above(0.0, "m"));
    v("sigma_base", noise_.base, "Of the ground that a node's bases lie on", above(0.0, "m"));
    v("min_height_share", min_height_share_,
      "Heights count when this share of the matched bases agrees", between(0.0, 1.0));
    v("max_height_change", max_height_change_, "Nor do they when they would lift the guess further",
      above(0.0, "m"));
    v("sigma_tilt", noise_.tilt, "How well gravity is known", above(0.0, "rad"));
    v("max_sigma", max_sigma_, "Weak directions get this much, instead of a failure",
      above(0.0, "m"));
  }
  std::string check_params() const override {
    return radius_ > coarse_radius_ ? "radius must not be above coarse_radius" : "";
  }

  Alignment align(const Prepared& target, const Prepared& source, const SE3& T_target_source_guess,
                  const Context& context) const override {
    context.check_cancelled();
    if (!T_target_source_guess.finite()) return failure("the guess is not finite");
    if (!target.payload.trees) return failure("the target has no trees");
    if (!source.payload.trees) return failure("the source has no trees");
    const auto targets = usable(*target.payload.trees), sources = usable(*source.payload.trees);
    const Quat upright = q_upright_target(targets, sources, T_target_source_guess.q);
    const SE3 T_upright_target{upright, Vec3::Zero()};
    Alignment out =
        fit(turned(upright, targets), sources, T_upright_target * T_target_source_guess);
    out.T_target_source = T_upright_target.inverse() * out.T_target_source;
    Mat6 turn = Mat6::Identity();  // of the residual: its translation is in the target's axes
    turn.topLeftCorner<3, 3>() = T_upright_target.rotation();
    out.information = turn.transpose() * out.information * turn;
    out.information = Mat6(0.5 * (out.information + out.information.transpose()));
    return out;
  }

 private:
  static Alignment failure(const std::string& reason) {
    Alignment out;
    out.reason = reason;
    return out;
  }

  Alignment fit(const std::vector<Tree>& target, const std::vector<Tree>& source,
                const SE3& guess) const {
    constexpr int iterations = 12;  // it stands still after five or six
    Fit best{guess, Mat6::Zero(), 0};
    std::vector<Pair> pairs;
    Heights bases;
    bool known = false;
    for (int i = 0; i < iterations; ++i) {
      const double radius = i < iterations / 3 ? coarse_radius_ : radius_;
      pairs = mutual_pairs(target, source, best.T_target_source, radius, max_dbh_difference_);
      if (pairs.size() < std::size_t(min_matches_))
        return failure(std::to_string(pairs.size()) + " stems match, below min_matches " +
                       std::to_string(min_matches_));
      bases = heights(target, source, pairs, best.T_target_source);
      const double lifted = bases.offset + best.T_target_source.t.z() - guess.t.z();
      known = bases.share >= min_height_share_ && std::abs(lifted) <= max_height_change_;
      if (!known) std::fill(bases.weights.begin(), bases.weights.end(), 0.0);
      best =
          step(target, source, pairs, bases.weights, best.T_target_source, noise_, correct_tilt_);
      if (!known) best.T_target_source.t.z() = guess.t.z();
    }
    Alignment out = judged(best, pairs.size(), std::min(target.size(), source.size()));
    out.scores.emplace_back("height_share", known ? bases.share : 0.0);
    return out;
  }

  Alignment judged(const Fit& fit, std::size_t matches, std::size_t stems) const {
    Alignment out;
    out.T_target_source = fit.T_target_source;
    out.scores = {{"matches", double(matches)},
                  {"overlap", double(matches) / double(stems)},
                  {"rmse", fit.rmse}};
    out.information = bounded(fit.normal_equations);
    out.converged = fit.rmse <= max_rmse_ && fit.T_target_source.finite();
    if (!out.converged)
      out.reason =
          "rmse " + std::to_string(fit.rmse) + " m is above max_rmse " + std::to_string(max_rmse_);
    return out;
  }

  // Stems in a row do not say where along the row they are: no direction is worse than max_sigma.
  Mat6 bounded(const Mat6& normal_equations) const {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> eigen(normal_equations);
    const double least = 1 / (max_sigma_ * max_sigma_);
    const Eigen::Matrix<double, 6, 1> values = eigen.eigenvalues().cwiseMax(least);
    const Mat6 m = eigen.eigenvectors() * values.asDiagonal() * eigen.eigenvectors().transpose();
    return 0.5 * (m + m.transpose());
  }

  double coarse_radius_ = 1.0;
  double radius_ = 0.5;
  double max_dbh_difference_ = 0.15;
  int min_matches_ = 8;
  double max_rmse_ = 0.3;
  double min_height_share_ = 0.8;
  double max_height_change_ = 0.3;
  bool correct_tilt_ = false;
  Noise noise_;
  double max_sigma_ = 10.0;
};

}  // namespace tree_align

CAMBIUM_PLUGIN("tree_align", "0.1.0") {
  registry.add<tree_align::TreeAlign>("tree_align", "Stems on stems, from the guess of tree_match");
}
