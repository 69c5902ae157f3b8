// SPDX-License-Identifier: BSD-3-Clause
// Place recognition by the height of the points in each ring around the robot.
// Replace describe() and match() by your method; what to keep to: docs/write-a-plugin.md.
#include <algorithm>
#include <cmath>

#include "cambium/plugin.hpp"

using namespace cambium;

class MyMethod final : public PlaceRecognizer {
 public:
  void params(ParamVisitor& v) override {
    v("rings", rings_, "Fewer forgive a displacement, more tell places apart", between(1, 200));
    v("max_range", max_range_, "Points farther than this are ignored", above(0.0, "m"));
    v("candidates", candidates_, "At most so many proposals for a node", between(1, 1000));
  }
  // A turn on the spot moves no point to another ring.
  bool yaw_invariant() const override { return true; }

  // What is remembered of a mission: one row of numbers a node. Computed once, then cached.
  Fingerprints describe(const MissionView& mission, const Context& context) const override {
    Fingerprints out{mission.size(), std::size_t(rings_), {}, {}};
    out.table.resize(out.rows * out.cols);
    context.parallel_for(out.rows, [&](std::size_t node) {
      const Payload payload = mission.payload(node);
      if (payload.cloud) heights(*payload.cloud, out.table.data() + node * out.cols);
    });
    return out;
  }

  std::vector<Candidate> match(const Fingerprints& query, const Fingerprints& reference,
                               const Pairing& pairing, const Context& context) const override {
    std::vector<Candidate> out;
    for (std::size_t q = 0; q < query.rows; ++q) {
      context.check_cancelled();
      std::vector<Candidate> found;
      for (std::size_t r = 0; r < reference.rows; ++r)
        if (pairing.allowed(q, r))
          found.push_back({q, r, -distance(query.row(q), reference.row(r)), {}});
      std::ranges::stable_sort(found, std::greater{}, &Candidate::score);
      found.resize(std::min(found.size(), std::size_t(candidates_)));
      out.insert(out.end(), found.begin(), found.end());
    }
    return out;
  }

 private:
  void heights(const Cloud& cloud, float* row) const {
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      const float* p = &cloud.xyz[3 * i];
      const double ring = std::hypot(p[0], p[1]) * rings_ / max_range_;
      if (ring < rings_ && std::isfinite(p[2])) row[int(ring)] = std::max(row[int(ring)], p[2]);
    }
  }
  static double distance(std::span<const float> a, std::span<const float> b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += std::abs(double(a[i]) - b[i]);
    return sum;
  }

  int rings_ = 40, candidates_ = 3;
  double max_range_ = 40.0;
};

CAMBIUM_PLUGIN("my_method", "0.1.0") {
  registry.add<MyMethod>("my_method", "Heights of the rings around the robot");
}
