// SPDX-License-Identifier: BSD-3-Clause
#include "consensus.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cambium/statistics.hpp"

namespace tree_match {
namespace {

using cambium::SE3;
using cambium::Vec3;

/// An answer, as the place of the query's whole mission in the reference mission.
struct Placement {
  SE3 T_reference_query;  ///< of the missions' frames
  double path;            ///< of the query's node [m]
  double reference_path;  ///< of the reference's node [m]
  bool sure;
};

/// `compatible`: another pass of the reference may be elsewhere in its frame, by its drift.
enum class Opinion { agrees, compatible, contradicts };

class Neighbourhood {
 public:
  Neighbourhood(const std::vector<std::optional<Found>>& found, const Place& query,
                const Place& reference, const Limits& limits)
      : limits_(limits.consensus), acceptance_(limits.acceptance), query_(query) {
    placements_.resize(found.size());
    for (std::size_t q = 0; q < found.size(); ++q) {
      if (!found[q]) continue;
      const std::size_t r = found[q]->reference;
      placements_[q] = {reference.T_mission_node[r] * found[q]->T_reference_query *
                            query.T_mission_node[q].inverse(),
                        query.path[q], reference.path[r], found[q]->sure};
    }
  }

  bool stands(std::size_t q) const {
    int support = 0, compatible = 0, contradict = 0;
    each_within(q, limits_.window, [&](std::size_t other) {
      if (other == q || !placements_[other]->sure) return;
      const Opinion opinion = of(other, q);
      compatible += opinion != Opinion::contradicts;
      contradict += opinion == Opinion::contradicts;
      support += opinion == Opinion::agrees &&
                 std::abs(query_.path[other] - query_.path[q]) <= limits_.support_window;
    });
    return contradict <= compatible && (placements_[q]->sure || support >= limits_.min_support);
  }

  /// By how much the neighbours would lift the query's node in the reference's frame [m].
  double lift(std::size_t q) const {
    std::vector<double> heights;
    each_within(q, limits_.window, [&](std::size_t other) {
      const auto &a = *placements_[q], &b = *placements_[other];
      const bool same_pass = std::abs(a.reference_path - b.reference_path) <= limits_.window;
      if (other == q || (b.sure && same_pass && of(other, q) != Opinion::contradicts))
        heights.push_back(height(other) + rise(other, q));
    });
    return cambium::median(heights) - height(q);
  }

 private:
  // How far above the height that it has in its mission a placement puts its own node. The tilt of
  // the two frames, which no answer knows well, does little there.
  double height(std::size_t q) const {
    const Vec3 at = query_.T_mission_node[q].t;
    return (placements_[q]->T_reference_query * at).z() - at.z();
  }

  // Where gravity is wrong in one mission, so is this: its frame is a slope in the other's.
  double rise(std::size_t from, std::size_t to) const {
    const SE3& T = placements_[to]->T_reference_query;
    if ((T.q * Vec3::UnitZ()).z() > std::cos(wrong_gravity)) return 0;
    const Vec3 way = query_.T_mission_node[to].t - query_.T_mission_node[from].t;
    return (T.q * way).z() - way.z();
  }

  Opinion of(std::size_t other, std::size_t q) const {
    const Placement &a = *placements_[q], &b = *placements_[other];
    const Vec3 at = query_.T_mission_node[q].t;
    const double apart = (a.T_reference_query * at - b.T_reference_query * at).head<2>().norm();
    const double turned = std::abs(std::remainder(
        a.T_reference_query.yaw() - b.T_reference_query.yaw(), 2 * std::numbers::pi));
    const double between =
        std::abs(a.path - b.path) + std::abs(a.reference_path - b.reference_path);
    if (apart <= limits_.agree && turned <= limits_.agree_yaw) return Opinion::agrees;
    const bool one_place = apart <= acceptance_.distinct + acceptance_.drift * between;
    return one_place && turned <= same_yaw ? Opinion::compatible : Opinion::contradicts;
  }

  template <class Visit>
  void each_within(std::size_t q, double window, const Visit& visit) const {
    const auto begin = query_.path.begin(), end = query_.path.end();
    const auto first = std::lower_bound(begin, end, query_.path[q] - window) - begin;
    const auto last = std::upper_bound(begin, end, query_.path[q] + window) - begin;
    for (auto i = std::size_t(first); i < std::size_t(last); ++i)
      if (placements_[i]) visit(i);
  }

  ConsensusLimits limits_;
  Acceptance acceptance_;
  const Place& query_;
  std::vector<std::optional<Placement>> placements_;
};

}  // namespace

std::vector<std::optional<Found>> by_consensus(const std::vector<std::optional<Found>>& found,
                                               const Place& query, const Place& reference,
                                               const Limits& limits) {
  const Neighbourhood neighbourhood(found, query, reference, limits);
  std::vector<std::optional<Found>> out(found.size());
  for (std::size_t q = 0; q < found.size(); ++q) {
    if (!found[q] || !neighbourhood.stands(q)) continue;
    out[q] = found[q];
    // Up is that of the reference's frame, not of its node.
    const SE3& T_mission_reference = reference.T_mission_node[found[q]->reference];
    const Vec3 up = T_mission_reference.q.conjugate() * Vec3::UnitZ();
    out[q]->T_reference_query.t += neighbourhood.lift(q) * up;
  }
  return out;
}

}  // namespace tree_match
