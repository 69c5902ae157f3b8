// SPDX-License-Identifier: BSD-3-Clause
// Place recognition by the share of a cloud's points in each ring around the robot. A turn on the
// spot moves no point to another ring.
#include <algorithm>
#include <cmath>

#include "cambium/plugin.hpp"

using namespace cambium;

class RingKey final : public PlaceRecognizer {
 public:
  void params(ParamVisitor& v) override {
    v("rings", rings_, "Fewer forgive a displacement, more tell places apart", between(1, 200));
    v("max_range", max_range_, "Points farther than this are ignored", above(0.0, "m"));
    v("candidates", candidates_, "At most so many proposals for a node", between(1, 1000));
    v("min_score", min_score_, "Pairs that have less in common are not proposed", between(0, 1));
  }
  bool yaw_invariant() const override { return true; }
  Fingerprints describe(const MissionView& mission, const Context& context) const override {
    Fingerprints keys{mission.size(), std::size_t(rings_), {}, {}};
    keys.table.resize(keys.rows * keys.cols);
    context.parallel_for(keys.rows, [&](std::size_t node) {
      const Payload payload = mission.payload(node);
      if (payload.cloud) add_shares(*payload.cloud, keys.table.data() + node * keys.cols);
    });
    return keys;
  }

  std::vector<Candidate> match(const Fingerprints& query, const Fingerprints& reference,
                               const Pairing& pairing, const Context& context) const override {
    std::vector<Candidate> proposed;
    for (std::size_t q = 0; q < query.rows; ++q) {
      context.check_cancelled();
      std::vector<Candidate> found;
      for (std::size_t r = 0; r < reference.rows; ++r) {
        double common = 0;  // the histogram intersection: 1 for the same key, 0 for an empty cloud
        for (std::size_t i = 0; i < query.cols; ++i)
          common += std::min(query.row(q)[i], reference.row(r)[i]);
        if (common > min_score_ && pairing.allowed(q, r)) found.push_back({q, r, common, {}});
      }
      std::ranges::stable_sort(found, std::greater{}, &Candidate::score);
      found.resize(std::min(found.size(), std::size_t(candidates_)));
      proposed.insert(proposed.end(), found.begin(), found.end());
    }
    return proposed;
  }

 private:
  void add_shares(const Cloud& cloud, float* key) const {
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      const double ring = std::hypot(cloud.xyz[3 * i], cloud.xyz[3 * i + 1]) * rings_ / max_range_;
      if (ring < rings_) key[int(ring)] += 1.0f / float(cloud.size());  // false for NaN
    }
  }
  int rings_ = 40, candidates_ = 3;
  double max_range_ = 60.0, min_score_ = 0.5;
};

CAMBIUM_PLUGIN("ring_key", "1.0.0") { registry.add<RingKey>("ring_key", "Points per ring"); }
