// SPDX-License-Identifier: BSD-3-Clause
// Place recognition by the pattern that tree stems make.
#include "cambium/path.hpp"
#include "cambium/plugin.hpp"
#include "consensus.hpp"

namespace tree_match {

using namespace cambium;

/// The first node, and every one that is `spacing` or more along the path from the one before.
std::vector<std::size_t> spread(const std::vector<double>& path, double spacing) {
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < path.size(); ++i)
    if (out.empty() || path[i] - path[out.back()] >= spacing) out.push_back(i);
  return out;
}

class TreeMatch final : public PlaceRecognizer {
 public:
  void params(ParamVisitor& v) override;
  bool yaw_invariant() const override { return true; }

  Fingerprints describe(const MissionView& mission, const Context& context) const override {
    Place place;
    for (const Node& node : mission.mission().nodes)
      place.T_mission_node.push_back(node.T_mission_node);
    place.path = cambium::travelled(mission.mission());
    const auto seen = tables(mission, map_, context);
    place.begin.push_back(0);
    for (const Table& table : seen) {
      for (const Detection& d : table) place.detections.push_back(d.stem);
      place.begin.push_back(place.detections.size());
    }
    place.stems = stem_map(mission.mission(), seen, map_, context);
    place.triangles = triangles(place.stems, StemGrid(place.stems), limits_.triangles);
    return to_fingerprints(place);
  }

  std::vector<Candidate> match(const Fingerprints& query, const Fingerprints& reference,
                               const Pairing& pairing, const Context& context) const override {
    const Place from = from_fingerprints(query);
    const Reference to(from_fingerprints(reference), limits_);
    if (!pairing.within_mission && probe_spacing_ > 0 && !may_have_met(from, to, context))
      return {};
    std::vector<std::optional<Found>> found(query.rows);
    context.parallel_for(query.rows, [&](std::size_t q) {
      context.check_cancelled();
      // Within a mission, the allowed nodes are those up to some node: the path never shrinks.
      std::uint32_t end = 0;
      while (end < reference.rows && pairing.allowed(q, end)) ++end;
      if (end > 0) found[q] = to.locate(from, q, end);
    });
    found = by_consensus(found, from, to.place(), limits_);
    std::vector<Candidate> out;
    for (std::size_t q = 0; q < found.size(); ++q)
      if (found[q])
        out.push_back({q, found[q]->reference, found[q]->score, found[q]->T_reference_query});
    return out;
  }

 private:
  void map_params(ParamVisitor& v);
  void shape_params(ParamVisitor& v);
  void pose_params(ParamVisitor& v);
  void consensus_params(ParamVisitor& v);

  /// Tries a query every `probe_spacing` only. The others see nearly the same stems, so where none
  /// of these could be accepted, none of them would be: missions that never met cost an eighth.
  bool may_have_met(const Place& from, const Reference& to, const Context& context) const {
    const auto probes = spread(from.path, probe_spacing_);
    std::vector<std::uint8_t> held(probes.size());
    context.parallel_for(probes.size(), [&](std::size_t i) {
      context.check_cancelled();
      held[i] = to.may_hold(from, probes[i]);
    });
    return std::ranges::any_of(held, [](std::uint8_t h) { return h != 0; });
  }

  MapLimits map_;
  Limits limits_;
  double probe_spacing_ = 10.0;
};

void TreeMatch::map_params(ParamVisitor& v) {
  v("cluster_radius", map_.radius, "Detections of one stem lie within this distance",
    above(0.0, "m"));
  v("min_sightings", map_.min_sightings, "Stems seen by fewer nodes are taken for false",
    between(1, 1000));
  v("revisit", map_.revisit, "A stem not seen for so long along the path is another one then",
    above(0.0, "m"));
  v("max_track", map_.max_track, "A stem in view for so long along the path is another one then",
    above(0.0, "m"));
  v("max_range", map_.max_range, "Detections farther from their node are not used",
    above(0.0, "m"));
  v("max_clearance_change", map_.max_clearance_change,
    "Heights are not used where the ground is this much farther off than usual", above(0.0, "m"));
}

void TreeMatch::shape_params(ParamVisitor& v) {
  auto& [query, triangles, index, votes, alignment, acceptance, consensus, finalists, table_radius,
         table_matches, sigma_tilt] = limits_;
  v("window", query.window, "A query is made of the stems seen up to so far along the path",
    at_least(0.0, "m"));
  v("range", query.range, "A query is made of the stems up to so far from its node",
    above(0.0, "m"));
  v("max_stems", query.max_stems, "At most so many stems of a query, the nearest",
    between(3, 1000));
  v("neighbours", triangles.neighbours, "Triangles are made of a stem and this many nearest ones",
    between(2, 30));
  v("reach", triangles.reach, "Neighbours are at most so far away", between(1.0, 30.0, "m"));
  v("min_side", triangles.min_side, "Shortest side of a triangle", above(0.0, "m"));
  v("min_side_gap", triangles.min_side_gap, "Least difference of two sides", at_least(0.0, "m"));
  v("centre_tree", triangles.centre_tree,
    "False: triangles of three neighbours, without the stem that they are neighbours of");
  v("cell", index.cell, "Sides are hashed in cells of this width", between(0.01, 10.0, "m"));
  v("probe", index.probe, "Look into the 8 nearest cells, not only into a triangle's own");
}

void TreeMatch::pose_params(ParamVisitor& v) {
  v("max_side_difference", limits_.index.max_side_difference, "Of the sides of two triangles",
    above(0.0, "m"));
  v("max_dbh_difference", limits_.index.max_dbh_difference, "Of the stems of two triangles",
    above(0.0, "m"));
  v("max_height_difference", limits_.index.max_height_difference,
    "Of the bases of two triangles, relative to their first stem", above(0.0, "m"));
  v("bin", limits_.votes.bin, "Votes for a position are counted in bins of this width",
    above(0.0, "m"));
  v("bin_yaw", limits_.votes.bin_yaw, "Votes for a heading likewise", between(0.001, 3.2, "rad"));
  v("bins", limits_.votes.bins, "So many of the fullest bins become hypotheses", between(1, 254));
  v("coarse_radius", limits_.alignment.coarse_radius, "Stems match within this distance at first",
    above(0.0, "m"));
  v("radius", limits_.alignment.radius, "Stems match within this distance in the end",
    above(0.0, "m"));
  v("sigma", limits_.alignment.sigma, "Of the offset of two matched stems, per axis",
    above(0.0, "m"));
  v("detection", limits_.alignment.detection, "Share of the stems that another mission sees, too",
    between(0.01, 0.99));
  v("cover", limits_.alignment.cover, "What lies so near to a stem has been seen", above(0.0, "m"));
  v("finalists", limits_.finalists, "Hypotheses that are refined to the end", between(1, 254));
  v("table_radius", limits_.table_radius, "How far a map may have drifted from a node",
    above(0.0, "m"));
  v("table_matches", limits_.table_matches,
    "Stems that two nodes must both see to be aligned alone", between(3, 1000));
  v("sigma_tilt", limits_.sigma_tilt, "How well gravity is known", above(0.0, "rad"));
}

void TreeMatch::consensus_params(ParamVisitor& v) {
  auto& consensus = limits_.consensus;
  v("support_window", consensus.support_window,
    "Answers of neighbours up to so far along the path support one another", at_least(0.0, "m"));
  v("min_support", consensus.min_support,
    "Answers below min_score or min_margin count when so many sure neighbours agree",
    between(1, 1000));
  v("supported_score", consensus.supported_score, "Least score of such answers");
  v("consensus_window", consensus.window,
    "Neighbours up to so far along the path may outvote an answer, and say how high it is",
    at_least(0.0, "m"));
  v("agree", consensus.agree, "Two answers that put a node at most so far apart agree",
    above(0.0, "m"));
  v("agree_yaw", consensus.agree_yaw, "And turn it at most by so much", above(0.0, "rad"));
}

void TreeMatch::params(ParamVisitor& v) {
  map_params(v);
  v("probe_spacing", probe_spacing_,
    "Between missions, queries so far apart along the path come first; the others follow where one "
    "of these finds something. 0 = all at once",
    at_least(0.0, "m"));
  shape_params(v);
  pose_params(v);
  consensus_params(v);
  auto& accept = limits_.acceptance;
  v("min_matches", accept.min_matches, "Fewer matched stems are no place", between(3, 1000));
  v("min_score", accept.min_score, "Least logarithm of the likelihood ratio", at_least(0.0));
  v("min_margin", accept.min_margin,
    "Share of the score by which every other place must stay below it", between(0.0, 1.0));
  v("distinct", accept.distinct, "Hypotheses nearer than this are the same place", above(0.0, "m"));
  v("drift", accept.drift,
    "Two passes of a place lie apart by up to this share of the path between", between(0.0, 1.0));
  v("max_distance", accept.max_distance, "Nodes farther apart are not proposed", above(0.0, "m"));
}

}  // namespace tree_match

CAMBIUM_PLUGIN("tree_match", "0.1.0") {
  registry.add<tree_match::TreeMatch>(
      "tree_match", "Stem maps matched by scalene triangles that vote for the pose");
}
