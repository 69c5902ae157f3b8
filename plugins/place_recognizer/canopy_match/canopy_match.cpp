// SPDX-License-Identifier: BSD-3-Clause
// Place recognition between the ground and the air: stems against tree tops, as whole maps.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "cambium/plugin.hpp"
#include "hypotheses.hpp"
#include "overlay.hpp"
#include "tree_map.hpp"

namespace canopy_match {

using namespace cambium;

class CanopyMatch final : public PlaceRecognizer {
 public:
  void params(ParamVisitor& v) override {
    v("cluster_radius", cluster_radius_, "Detections nearer to each other are one tree",
      above(0.0, "m"));
    v("min_sightings", min_sightings_, "Trees seen by fewer nodes are left out", between(1, 1000));
    v("bin", bin_, "Votes for a position are counted in bins of this width",
      between(0.1, 10.0, "m"));
    v("hypotheses", hypotheses_, "So many of the fullest bins are refined", between(1, 10000));
    v("coarse_radius", overlay_.coarse_radius, "Trees match within this distance at first",
      above(0.0, "m"));
    v("radius", overlay_.radius, "Trees match within this distance in the end", above(0.0, "m"));
    v("cover", overlay_.cover, "A mission has looked where a tree of it is so near",
      above(0.0, "m"));
    v("min_matches", min_matches_, "Fewer matched trees are no place", between(3, 100000));
    v("min_score", min_score_, "Least logarithm of the likelihood ratio", at_least(0.0));
    v("min_margin", min_margin_, "Share of the score by which every other place must stay below it",
      between(0.0, 1.0));
    v("range", range_, "Each node is placed anew by the trees around it", above(0.0, "m"));
    v("node_matches", node_matches_, "Fewer matched trees around a node do not place it",
      between(3, 1000));
    v("max_distance", max_distance_,
      "Nodes farther apart than this are not proposed; heights do not count", above(0.0, "m"));
  }
  std::string check_params() const override {
    return overlay_.radius > overlay_.coarse_radius ? "radius must not be above coarse_radius" : "";
  }
  bool yaw_invariant() const override { return true; }

  Fingerprints describe(const MissionView& mission, const Context& context) const override {
    return to_fingerprints(map_trees(mission, cluster_radius_, min_sightings_, context));
  }

  std::vector<Candidate> match(const Fingerprints& query, const Fingerprints& reference,
                               const Pairing& pairing, const Context& context) const override {
    // A mission's own map holds every tree once: it says nothing about its loops.
    if (pairing.within_mission) return {};
    const TreeMap from = from_fingerprints(query), to = from_fingerprints(reference);
    const Neighbours trees(to.trees, overlay_.coarse_radius);
    const auto placed = place(from, to, trees, context);
    if (!placed) return {};
    std::vector<std::optional<Candidate>> found(from.T_mission_node.size());
    context.parallel_for(found.size(), [&](std::size_t q) {
      found[q] = node_candidate(q, from, to, trees, *placed);
    });
    std::vector<Candidate> out;
    for (const auto& c : found)
      if (c) out.push_back(*c);
    return out;
  }

 private:
  /// The whole query in the reference, when no other place is nearly as likely.
  std::optional<Overlay> place(const TreeMap& from, const TreeMap& to, const Neighbours& trees,
                               const Context& context) const {
    const auto starts = hypotheses(to.trees, from.trees, bin_, std::size_t(hypotheses_), context);
    std::vector<Overlay> overlays(starts.size());
    context.parallel_for(starts.size(), [&](std::size_t i) {
      context.check_cancelled();
      overlays[i] = lay_over(to.trees, trees, from.trees, starts[i], overlay_);
    });
    const Overlay* best = nullptr;
    for (const Overlay& o : overlays)
      if (!best || o.score > best->score) best = &o;
    if (!best || best->matches < std::size_t(min_matches_) || best->score < min_score_)
      return std::nullopt;
    for (const Overlay& o : overlays)
      if (elsewhere(o, *best, from) && o.score > (1 - min_margin_) * best->score)
        return std::nullopt;
    return *best;
  }

  /// Whether the two put the query's middle or its heading at different places.
  bool elsewhere(const Overlay& a, const Overlay& b, const TreeMap& from) const {
    Vec3 centre = Vec3::Zero();
    for (const Vec3& p : from.trees) centre += p / double(from.trees.size());
    const double apart =
        (a.T_reference_query * centre - b.T_reference_query * centre).head<2>().norm();
    const double turned = std::abs(std::remainder(
        a.T_reference_query.yaw() - b.T_reference_query.yaw(), 2 * std::numbers::pi));
    return apart > 2 * overlay_.coarse_radius || turned > 0.2;
  }

  std::optional<Candidate> node_candidate(std::size_t q, const TreeMap& from, const TreeMap& to,
                                          const Neighbours& trees, const Overlay& placed) const {
    const SE3& T_mission_q = from.T_mission_node[q];
    std::vector<Vec3> near;  // the mission has drifted: here it may lie a little off
    for (const Vec3& p : from.trees)
      if ((p - T_mission_q.t).head<2>().norm() <= range_) near.push_back(p);
    const Overlay here = lay_over(to.trees, trees, near, placed.T_reference_query, overlay_);
    if (here.matches < std::size_t(node_matches_)) return std::nullopt;
    const SE3 T_to_q = here.T_reference_query * T_mission_q;
    std::size_t nearest = 0;
    double least = max_distance_;
    for (std::size_t r = 0; r < to.T_mission_node.size(); ++r) {
      const double d = (to.T_mission_node[r].t - T_to_q.t).head<2>().norm();
      if (d < least) least = d, nearest = r;
    }
    if (least >= max_distance_) return std::nullopt;
    return Candidate{q, nearest, here.score, to.T_mission_node[nearest].inverse() * T_to_q};
  }

  double cluster_radius_ = 0.8;
  int min_sightings_ = 2;
  double bin_ = 1.0;
  int hypotheses_ = 60;
  OverlayLimits overlay_;
  int min_matches_ = 12;
  double min_score_ = 20;
  double min_margin_ = 0.3;
  double range_ = 30;
  int node_matches_ = 10;
  double max_distance_ = 60;
};

}  // namespace canopy_match

CAMBIUM_PLUGIN("canopy_match", "0.1.0") {
  registry.add<canopy_match::CanopyMatch>(
      "canopy_match", "Stems against tree tops: ties missions on the ground to missions above");
}
