// SPDX-License-Identifier: BSD-3-Clause
// Place recognition by features of density pictures: the idea of MapClosures (Gupta, Guadagnino,
// Mersch, Vizzo, Stachniss, ICRA 2024), written from the paper.
#include <algorithm>
#include <cstring>

#include "cambium/plugin.hpp"
#include "common/levelled.hpp"
#include "consensus.hpp"

namespace bev_density {

using namespace cambium;

// A row of the fingerprints: q_level_base, then how many features the node has. All features stand
// in `extra`, node after node.
constexpr std::size_t columns_of_a_row = columns::rotation_size + 1;

class BevDensity final : public PlaceRecognizer {
 public:
  void params(ParamVisitor& v) override {
    v("cell", grid_.cell, "Edge of a pixel", between(0.05, 10.0, "m"));
    v("max_range", grid_.max_range, "Points farther from the base, horizontally, do not count",
      above(0.0, "m"));
    v("lowest", grid_.lowest, "Points farther below the base do not count", in_unit("m"));
    v("highest", grid_.highest, "Points farther above the base do not count", in_unit("m"));
    v("layers", grid_.layers, "Between lowest and highest; a pixel shows how many are filled",
      between(1, 64));
    v("level", level_, "Set each cloud upright by the roll and pitch of its node first");
    v("features", features_.count, "At most so many corners of a picture", between(2, 5000));
    v("corner_threshold", features_.threshold,
      "By how much a corner differs from the pixels around it, of 255 (FAST)", between(1, 254));
    v("patch", features_.patch, "Edge of what is described of a corner, in pixels",
      between(15, 101));
    v("max_bits", max_bits_, "Corners that differ in more of their 256 bits do not match",
      between(0, 256));
    v("tolerance", consensus_.tolerance,
      "Matched corners so near each other agree with a turn and shift", above(0.0, "m"));
    v("hypotheses", consensus_.hypotheses,
      "Of the most alike matches so many are taken in twos to fix a turn and shift",
      between(2, 1000));
    v("min_inliers", min_inliers_, "Pairs in which fewer corners agree are not proposed",
      between(2, 5000));
    v("candidates", candidates_, "At most so many proposals for a query", between(1, 10000));
  }
  std::string check_params() const override {
    if (grid_.lowest >= grid_.highest) return "lowest must be below highest";
    return grid_.side() <= 4096 ? "" : "cell is too small for max_range: more than 4096 pixels";
  }
  bool yaw_invariant() const override { return true; }

  Fingerprints describe(const MissionView& mission, const Context& context) const override {
    Fingerprints out{mission.size(), columns_of_a_row, {}, {}};
    out.table.resize(out.rows * out.cols, 0.0f);
    std::vector<Features> features(out.rows);
    context.parallel_for(out.rows, [&](std::size_t i) {
      context.check_cancelled();
      const std::span<float> row{out.table.data() + i * out.cols, out.cols};
      const Cloud::Matrix3X points =
          columns::upright_points(mission, i, level_, row.first(columns::rotation_size));
      if (points.cols() > 0)
        features[i] = find_features(make_picture(points, grid_), grid_, features_);
      row.back() = float(features[i].size());
    });
    for (const Features& of_node : features) {
      append(out.extra, of_node.at);
      append(out.extra, of_node.bits);
    }
    return out;
  }

  std::vector<Candidate> match(const Fingerprints& query, const Fingerprints& reference,
                               const Pairing& pairing, const Context& context) const override {
    const auto of_query = decode(query), of_reference = decode(reference);
    std::vector<std::vector<Candidate>> found(query.rows);
    context.parallel_for(query.rows, [&](std::size_t q) {
      for (std::size_t r = 0; r < reference.rows; ++r) {
        if (r % 64 == 0) context.check_cancelled();
        if (!pairing.allowed(q, r)) continue;
        const auto matches = match_features(of_query[q], of_reference[r], max_bits_);
        if (matches.size() < std::size_t(min_inliers_)) continue;
        const Consensus c = agree(of_query[q], of_reference[r], matches, consensus_);
        if (c.inliers < std::size_t(min_inliers_)) continue;
        found[q].push_back(
            {q, r, double(c.inliers),
             T_level_base(reference, r).inverse() * c.T_reference_query * T_level_base(query, q)});
      }
      std::ranges::stable_sort(found[q], std::greater{}, &Candidate::score);
      found[q].resize(std::min(found[q].size(), std::size_t(candidates_)));
    });
    std::vector<Candidate> out;
    for (const auto& of_node : found) out.insert(out.end(), of_node.begin(), of_node.end());
    return out;
  }

 private:
  static SE3 T_level_base(const Fingerprints& fingerprints, std::size_t node) {
    return columns::T_level_base(fingerprints.row(node).first(columns::rotation_size));
  }

  template <class T>
  static void append(std::vector<std::byte>& to, const std::vector<T>& values) {
    const auto bytes = std::as_bytes(std::span(values));
    to.insert(to.end(), bytes.begin(), bytes.end());
  }
  template <class T>
  static void take(const std::byte*& from, std::vector<T>& values, std::size_t count) {
    values.resize(count);
    if (count > 0) std::memcpy(values.data(), from, count * sizeof(T));
    from += count * sizeof(T);
  }

  static std::vector<Features> decode(const Fingerprints& fingerprints) {
    std::vector<Features> out(fingerprints.rows);
    const std::byte* from = fingerprints.extra.data();
    for (std::size_t i = 0; i < out.size(); ++i) {
      const auto count = std::size_t(fingerprints.row(i).back());
      take(from, out[i].at, count);
      take(from, out[i].bits, count);
    }
    return out;
  }

  PictureGrid grid_;
  FeatureOptions features_;
  ConsensusOptions consensus_;
  bool level_ = true;
  int max_bits_ = 80, min_inliers_ = 5, candidates_ = 5;
};

}  // namespace bev_density

CAMBIUM_PLUGIN("bev_density", "0.1.0") {
  registry.add<bev_density::BevDensity>(
      "bev_density", "ORB features of density pictures, matched and aligned (after MapClosures)");
}
