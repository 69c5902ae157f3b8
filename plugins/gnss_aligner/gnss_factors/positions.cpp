// SPDX-License-Identifier: BSD-3-Clause
#include "positions.hpp"

#include <algorithm>
#include <cmath>

#include "cambium/statistics.hpp"

namespace gnss_factors {
namespace {

using namespace cambium;
using gnss::Measurement;

constexpr std::size_t window_fixes = 61;  ///< enough for a median, whatever the receiver's rate
constexpr double median_of_rayleigh = 1.1774100225154747;  ///< sqrt(2 ln 2)

/// Where a fix puts the path, from where the map has it [m].
struct Offset {
  double seconds;
  std::uint32_t node;  // the nearest in time
  Vec3 d_map;
  Mat3 covariance;  // east, north, up
};

std::vector<Offset> offsets_of(const gnss::Track& track, const SE3& T_map_enu) {
  std::vector<Offset> out;
  for (const Measurement& m : track.measurements)
    out.push_back({m.seconds, m.share < 0.5 ? m.before : m.after,
                   T_map_enu * m.pair.p_enu - m.pair.p_map, m.pair.covariance});
  return out;
}

/// Horizontal distance of every fix from the running median, over its stated sigma.
std::vector<double> departures(const std::vector<Offset>& offsets, double window) {
  std::vector<double> out;
  std::size_t first = 0, last = 0;
  for (const Offset& o : offsets) {
    while (offsets[first].seconds < o.seconds - window / 2) ++first;
    while (last < offsets.size() && offsets[last].seconds <= o.seconds + window / 2) ++last;
    const std::size_t step = (last - first - 1) / window_fixes + 1;
    std::vector<double> x, y;
    for (std::size_t i = first; i < last; i += step) {
      x.push_back(offsets[i].d_map.x());
      y.push_back(offsets[i].d_map.y());
    }
    const double off = std::hypot(o.d_map.x() - median(x), o.d_map.y() - median(y));
    out.push_back(off / std::sqrt(gnss::horizontal_variance(o.covariance)));
  }
  return out;
}

/// The fixes nearest to one node.
struct Group {
  Vec3 sum = Vec3::Zero();
  Mat3 covariance = Mat3::Zero();  // summed
  double weight = 0, seconds = 0, first = 0, last = 0;
  std::size_t count = 0;

  void add(const Offset& o) {
    const double w = 1 / gnss::horizontal_variance(o.covariance);
    if (count++ == 0) first = o.seconds;
    last = o.seconds;
    sum += w * o.d_map;
    weight += w;
    covariance += o.covariance;
    seconds += o.seconds;
  }
  double middle() const { return seconds / double(count); }
};

/// Of the fixes of a group, how many are independent: those of all groups together are as many as
/// the time that they cover has double correlation times.
double independent(const Group& group, double covered, double correlation_time) {
  const double pieces = 2 * correlation_time;
  if (!(pieces > 0)) return double(group.count);
  return std::min({double(group.count), covered / pieces, 1 + (group.last - group.first) / pieces});
}

}  // namespace

std::vector<NodePosition> node_positions(const Atlas& atlas, const gnss::Track& track,
                                         const SE3& T_map_enu, const PositionSettings& settings) {
  const std::vector<Offset> offsets = offsets_of(track, T_map_enu);
  const std::vector<double> off = departures(offsets, settings.window);
  const double scatter = std::max(1.0, median(off) / median_of_rayleigh);
  const double limit =
      std::sqrt(-2 * std::log(std::erfc(settings.outlier_width / std::sqrt(2.0)))) * scatter;
  std::vector<std::pair<std::uint32_t, Group>> groups;  // in order of time
  for (std::size_t i = 0; i < offsets.size(); ++i) {
    if (off[i] > limit) continue;
    if (groups.empty() || groups.back().first != offsets[i].node)
      groups.push_back({offsets[i].node, {}});
    groups.back().second.add(offsets[i]);
  }
  const Mat3 R = T_map_enu.rotation();
  const Vec3 stretch = settings.sigma_scale * scatter * Vec3(1, 1, settings.vertical_scale);
  std::vector<NodePosition> out;
  for (std::size_t k = 0; k < groups.size(); ++k) {
    const auto& [node, group] = groups[k];
    const double begin = k > 0 ? groups[k - 1].second.middle() : group.first;
    const double end = k + 1 < groups.size() ? groups[k + 1].second.middle() : group.last;
    const double count =
        groups.size() == 1 ? 1 : independent(group, (end - begin) / 2, settings.correlation_time);
    if (!(count > 0)) continue;
    Mat3 C = group.covariance / (double(group.count) * count);
    C(2, 2) = std::max(C(2, 2), gnss::horizontal_variance(C));  // no receiver knows height better
    const Mat3 C_map = R * stretch.asDiagonal() * C * stretch.asDiagonal() * R.transpose();
    const NodeRef ref{track.mission, node};
    out.push_back({ref, atlas.T_map_node(ref).t + group.sum / group.weight, C_map.inverse()});
  }
  return out;
}

}  // namespace gnss_factors
