// SPDX-License-Identifier: BSD-3-Clause
#include "simulate/gnss.hpp"

#include <algorithm>
#include <cmath>

#include "simulate/clock.hpp"
#include "simulate/random.hpp"

namespace cambium::simulate {
namespace {

Vec3 place_at(const std::vector<TruePose>& truth, double time) {
  const auto after =
      std::find_if(truth.begin(), truth.end(), [&](const TruePose& p) { return p.time >= time; });
  if (after == truth.begin()) return after->T_world_base.t;
  if (after == truth.end()) return truth.back().T_world_base.t;
  const auto before = std::prev(after);
  const double s = (time - before->time) / (after->time - before->time);
  return (1 - s) * before->T_world_base.t + s * after->T_world_base.t;
}

/// Something that begins every `interval` seconds on average and lasts `duration` on average.
class Episodes {
 public:
  Episodes(double interval, double duration, Random random)
      : interval_(interval), duration_(duration), random_(random) {
    end_ = 0;
    next();
  }
  /// Whether one is on; `time` must not go back. A new one has a new strength.
  bool on(double time) {
    if (interval_ <= 0) return false;
    while (time >= end_) next();
    return time >= begin_;
  }
  double strength() const { return strength_; }  ///< standard normal

 private:
  void next() {
    begin_ = end_ + random_.exponential(interval_);
    end_ = begin_ + random_.exponential(duration_);
    strength_ = random_.normal();
  }
  double interval_, duration_;
  Random random_;
  double begin_ = 0, end_ = 0, strength_ = 0;
};

/// First-order Gauss-Markov process, stationary from the start.
struct GaussMarkov {
  double memory;  ///< correlation from one fix to the next
  Vec3 value;
  void advance(Random& r) {
    const double fresh = std::sqrt(1 - memory * memory);
    for (int k = 0; k < 3; ++k) value[k] = memory * value[k] + fresh * r.normal();
  }
};

}  // namespace

std::vector<GnssFix> observe(const std::vector<TruePose>& truth, const GnssSpec& spec,
                             std::int64_t start, const Geodetic& reference, std::uint64_t seed) {
  std::vector<GnssFix> out;
  if (!spec.enabled || truth.empty()) return out;
  const Random stream(seed, "gnss");
  Episodes jumps(spec.jump_interval, spec.jump_duration, stream.fork(1));
  Episodes outages(spec.outage_interval, spec.outage_duration, stream.fork(2));
  Random r = stream.fork(3);
  const double memory =
      spec.correlation_time > 0 ? std::exp(-1 / (spec.rate * spec.correlation_time)) : 0;
  GaussMarkov error{0, Vec3::Zero()};
  error.advance(r);
  error.memory = memory;
  const Vec3 sigma(spec.sigma, spec.sigma, spec.sigma * spec.vertical_factor);
  for (std::int64_t i = 0; double(i) / spec.rate <= truth.back().time; ++i, error.advance(r)) {
    const double time = double(i) / spec.rate;
    const double jump = jumps.on(time) ? spec.jump_height * jumps.strength() : 0;
    if (outages.on(time)) continue;
    const Vec3 p_enu =
        place_at(truth, time) + sigma.cwiseProduct(error.value) + jump * Vec3::UnitZ();
    const Geodetic g = from_enu(reference, p_enu);
    out.push_back({stamp_at(start, time), g.latitude, g.longitude, g.altitude,
                   Mat3(sigma.cwiseAbs2().asDiagonal())});
  }
  return out;
}

}  // namespace cambium::simulate
