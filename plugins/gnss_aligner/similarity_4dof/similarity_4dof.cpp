// SPDX-License-Identifier: BSD-3-Clause
// Georeferencing of DigiForest D3.1: yaw and translation between k nodes and their GNSS fixes.
#include <algorithm>
#include <cmath>

#include "cambium/plugin.hpp"
#include "closed_form.hpp"
#include "common/carry.hpp"
#include "fixed_nodes.hpp"

namespace similarity_4dof {
namespace {

using namespace cambium;
using namespace cambium::gnss;

/// A node with its place, of any mission of the island.
struct Measured {
  NodeRef node;
  FixedNode fixed;
};

Pair in_enu(const Atlas& atlas, const Measured& m, const Geodetic& reference) {
  return {to_enu(reference, m.fixed.place), atlas.T_map_node(m.node).t, m.fixed.covariance};
}

}  // namespace

class Similarity4Dof final : public GnssAligner {
 public:
  void params(ParamVisitor& v) override {
    v("nodes", nodes_, "How many nodes of each mission are used", between(2, 1e6));
    v("select", select_, "Which: spread over the path, or the first", one_of({"spread", "first"}));
    v("max_gap", max_gap_, "Nodes between fixes farther apart in time have no place",
      above(0, "s"));
    v("max_sigma_yaw", max_sigma_yaw_, "Refuse when yaw is known worse than this", above(0, "deg"));
  }

  GnssAlignment align(const Atlas& atlas, const Island& island,
                      const Context& context) const override {
    GnssAlignment result = from_fixes(atlas, island, context);
    return result.georeference ? result : or_carried(result, atlas, island);
  }

 private:
  GnssAlignment from_fixes(const Atlas& atlas, const Island& island, const Context& context) const {
    std::vector<Measured> measured;
    std::size_t fixes = 0;
    for (const std::uint32_t m : island.missions) {
      context.check_cancelled();
      const Mission& mission = *atlas.missions[m].mission;
      fixes += mission.fixes.size();
      for (const FixedNode& fixed :
           choose(fixed_nodes(mission, max_gap_), std::size_t(nodes_), select_ == "spread"))
        measured.push_back({{m, std::uint32_t(fixed.node)}, fixed});
    }
    GnssAlignment result;
    if (measured.size() < 3) {
      result.reason = std::to_string(measured.size()) + " nodes lie between GNSS fixes at most " +
                      number(max_gap_) + " s apart (of " + std::to_string(fixes) +
                      " fixes), at least 3 are needed; record more fixes or raise max_gap";
      return result;
    }
    return judge(atlas, measured);
  }

  GnssAlignment judge(const Atlas& atlas, const std::vector<Measured>& measured) const {
    const Geodetic reference = measured.front().fixed.place;
    std::vector<Pair> pairs;
    for (const Measured& m : measured) pairs.push_back(in_enu(atlas, m, reference));
    const Fit best = fit(pairs);
    GnssAlignment result;
    result.scores = {{"nodes", double(pairs.size())},
                     {"rmse_horizontal", best.rmse_horizontal},
                     {"max_horizontal", best.max_horizontal},
                     {"rmse_vertical", best.rmse_vertical},
                     {"residual_over_sigma", best.chi}};
    // Written so that it is also refused when yaw is not determined at all.
    if (!(best.sigma_yaw <= max_sigma_yaw_ * degree)) {
      result.reason = "yaw is known to " + number(best.sigma_yaw / degree) +
                      " deg only, allowed are " + number(max_sigma_yaw_) +
                      " (max_sigma_yaw): the " + std::to_string(pairs.size()) + " nodes reach " +
                      number(best.reach) +
                      " m around their centre; use more nodes, or select: spread";
      return result;
    }
    result.georeference =
        GeoReference{reference.latitude, reference.longitude, reference.altitude,
                     best.T_map_enu,     best.sigma_yaw,      best.sigma_position};
    return result;
  }

  int nodes_ = 10;
  std::string select_ = "spread";
  double max_gap_ = 2.0;
  double max_sigma_yaw_ = 10.0;
};

}  // namespace similarity_4dof

CAMBIUM_PLUGIN("similarity_4dof", "0.1.0") {
  registry.add<similarity_4dof::Similarity4Dof>(
      "similarity_4dof", "Yaw and translation between nodes and GNSS fixes, in closed form");
}
