// SPDX-License-Identifier: BSD-3-Clause
// Registration by iterated closest points on a subset of the points, in yaw and position.
// Replace align() by your method; what to keep to: docs/write-a-plugin.md.
#include <cmath>

#include "cambium/fit.hpp"
#include "cambium/plugin.hpp"

using namespace cambium;

class MyMethod final : public Registration {
 public:
  void params(ParamVisitor& v) override {
    v("points", points_, "So many points of each cloud are used", between(10, 100000));
    v("max_distance", max_distance_, "Points farther apart do not belong together",
      above(0.0, "m"));
    v("iterations", iterations_, "Rounds of closest points", between(1, 1000));
  }

  Alignment align(const Prepared& target, const Prepared& source, const SE3& T_target_source_guess,
                  const Context& context) const override {
    Alignment out;
    out.T_target_source = T_target_source_guess.finite() ? T_target_source_guess : SE3{};
    const std::vector<Vec3> a = subset(target), b = subset(source);
    std::vector<Vec3> from, to;
    double rmse = 0;
    for (int i = 0; i < iterations_; ++i) {
      context.check_cancelled();
      rmse = pair_up(a, b, out.T_target_source, from, to);
      if (from.size() < 10) {
        out.reason = "fewer than 10 points of one cloud are near the other";
        return out;
      }
      out.T_target_source = fit_yaw(to, from);
    }
    out.converged = true;
    out.scores = {{"overlap", double(from.size()) / double(b.size())}, {"rmse", rmse}};
    out.information = Mat6::Identity() / (0.01 + rmse * rmse);  // replace by what you know
    return out;
  }

 private:
  std::vector<Vec3> subset(const Prepared& prepared) const {
    std::vector<Vec3> out;
    if (!prepared.payload.cloud) return out;
    const Cloud& cloud = *prepared.payload.cloud;
    const std::size_t step = cloud.size() / std::size_t(points_) + 1;
    for (std::size_t i = 0; i < cloud.size(); i += step) {
      const Vec3 p = cloud.points().col(Eigen::Index(i)).cast<double>();
      if (p.allFinite()) out.push_back(p);
    }
    return out;
  }

  // Fills `from` and `to` with the source points and the target points nearest to them; RMS
  // distance.
  double pair_up(const std::vector<Vec3>& target, const std::vector<Vec3>& source, const SE3& T,
                 std::vector<Vec3>& from, std::vector<Vec3>& to) const {
    from.clear(), to.clear();
    double sum = 0;
    for (const Vec3& p : source) {
      double best = max_distance_ * max_distance_;
      const Vec3* nearest = nullptr;
      for (const Vec3& q : target)
        if (const double d = (q - T * p).squaredNorm(); d < best) best = d, nearest = &q;
      if (!nearest) continue;
      from.push_back(p), to.push_back(*nearest);
      sum += best;
    }
    return from.empty() ? 0 : std::sqrt(sum / double(from.size()));
  }

  int points_ = 600, iterations_ = 40;
  double max_distance_ = 1.5;
};

CAMBIUM_PLUGIN("my_method", "0.1.0") {
  registry.add<MyMethod>("my_method", "Closest points, yaw and position");
}
