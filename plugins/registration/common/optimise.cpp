// SPDX-License-Identifier: BSD-3-Clause
#include "common/optimise.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/normal_equations.hpp"

namespace cambium::registration {
namespace {

/// The counterpart of a source patch, and how long it is sure to stay that.
struct Pairing {
  Eigen::Vector3f searched_at = Eigen::Vector3f::Zero();  ///< where the source patch was
  Nearest nearest = {-1, 0, 0};                           ///< sure of nothing: search
};

class Pairs {
 public:
  Pairs(const Surface& target, std::size_t sources, float distance)
      : target_(target), distance_(distance), pairs_(sources) {}

  /// Index of the target patch nearest to `query`, -1 when none is within the distance. Exact: the
  /// last answer stands as long as the way since is too short for any other patch to be nearer.
  std::int32_t find(std::size_t source, const Eigen::Vector3f& query) {
    Pairing& pair = pairs_[source];
    if (!still_holds(pair, query))
      pair = {query, target_.index.nearest(query, distance_ * slack, distance_ * (slack - 1))};
    return within(pair, query);
  }

 private:
  // Searched farther than a pair may be, so that "none" also stands for a while.
  static constexpr float slack = 1.1F;

  bool still_holds(const Pairing& pair, const Eigen::Vector3f& query) const {
    const float way = (query - pair.searched_at).norm();
    const float others = std::sqrt(pair.nearest.others) - way;
    return others >= std::min(distance_, to(pair, query));
  }
  float to(const Pairing& pair, const Eigen::Vector3f& query) const {
    if (pair.nearest.index < 0) return distance_ * slack;
    return (query - target_.patches[std::size_t(pair.nearest.index)].at).norm();
  }
  std::int32_t within(const Pairing& pair, const Eigen::Vector3f& query) const {
    return to(pair, query) < distance_ ? pair.nearest.index : -1;
  }

  const Surface& target_;
  float distance_;
  std::vector<Pairing> pairs_;
};

class Optimiser {
 public:
  Optimiser(const Surface& target, const Patches& source, const Stage& stage, const Metric& metric)
      : target_(target),
        source_(source),
        stage_(stage),
        metric_(metric),
        pairs_(target, source.size(), float(stage.max_correspondence_distance)) {}

  /// Steps with every `stride`-th patch until one is shorter than `epsilons` times the stage's
  /// own limits.
  bool run(std::size_t stride, double epsilons, SE3& T) {
    for (; iteration_ < stage_.max_iterations; ++iteration_) {
      const NormalEquations sum = linearise(stride, T);
      if (sum.pairs() < 6) return false;
      const Vec6 step = sum.solve();
      T = SE3::exp(step) * T;
      if (!T.finite()) return false;
      // Of the source's origin, not of the target's: that may be far away.
      const double way = (step.head<3>() + step.tail<3>().cross(T.t)).norm();
      if (way < epsilons * stage_.translation_epsilon &&
          step.tail<3>().norm() < epsilons * stage_.rotation_epsilon)
        break;
    }
    return true;
  }

 private:
  NormalEquations linearise(std::size_t stride, const SE3& T) {
    const Eigen::Matrix3f R = T.rotation().cast<float>();
    const Eigen::Vector3f t = T.t.cast<float>();
    NormalEquations sum;
    for (std::size_t i = 0; i < source_.size(); i += stride) {
      const Eigen::Vector3f p = R * source_[i].at + t;
      const std::int32_t match = pairs_.find(i, p);
      if (match < 0) continue;
      const Patch& other = target_.patches[std::size_t(match)];
      sum.add(p, p - other.at,
              metric_.plane_thickness > 0 ? disc_to_disc(other.normal, R * source_[i].normal,
                                                         float(metric_.plane_thickness))
                                          : to_plane(other.normal));
    }
    return sum;
  }

  const Surface& target_;
  const Patches& source_;
  const Stage stage_;
  const Metric metric_;
  Pairs pairs_;
  int iteration_ = 0;
};

}  // namespace

std::optional<SE3> optimise(const Surface& target, const Patches& source, const SE3& guess,
                            const Stage& stage, const Metric& metric) {
  // The way to the minimum with few patches, the last steps with all.
  constexpr std::size_t few = 2000;
  SE3 T = guess;
  Optimiser optimiser(target, source, stage, metric);
  const std::size_t stride = std::max<std::size_t>(1, source.size() / few);
  if (stride > 1 && !optimiser.run(stride, 5, T)) return std::nullopt;
  if (!optimiser.run(1, 1, T)) return std::nullopt;
  return T;
}

}  // namespace cambium::registration
