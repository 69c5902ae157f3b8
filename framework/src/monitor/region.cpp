// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "monitor/place.hpp"

namespace cambium::monitor {
namespace {

/// Heights hardly move a place on the plan: it is taken at the height of the reference point.
Vec3 in_map(const GeoReference& g, const Geodetic& place) {
  return g.T_map_enu * to_enu({g.latitude, g.longitude, g.altitude},
                              {place.latitude, place.longitude, g.altitude});
}

/// Straight between degrees, as RFC 7946 has it.
std::vector<Vec3> ring_in_map(const GeoReference& g, const Ring& ring) {
  constexpr double longest = 1e-3;  // [deg], about 100 m: then the map's bend is below 1 mm
  std::vector<Vec3> out;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Geodetic &a = ring[i], &b = ring[(i + 1) % ring.size()];
    const double span =
        std::max(std::abs(b.latitude - a.latitude), std::abs(b.longitude - a.longitude));
    const int parts = std::clamp(int(std::ceil(span / longest)), 1, 10000);
    for (int k = 0; k < parts; ++k) {
      const double s = double(k) / parts;
      out.push_back(in_map(g, {a.latitude + s * (b.latitude - a.latitude),
                               a.longitude + s * (b.longitude - a.longitude), 0}));
    }
  }
  return out;
}

}  // namespace

Region::Region(const Place& place, const GeoReference& g) {
  if (place.centre) {
    middle_ = in_map(g, *place.centre);
    radius_ = place.radius;
    low_ = middle_ - Vec3::Constant(radius_);
    high_ = middle_ + Vec3::Constant(radius_);
    return;
  }
  for (const Ring& ring : place.rings) rings_.push_back(ring_in_map(g, ring));
  low_ = high_ = rings_.front().front();
  for (const auto& ring : rings_)
    for (const Vec3& p : ring) low_ = low_.cwiseMin(p), high_ = high_.cwiseMax(p);
  middle_ = 0.5 * (low_ + high_);
}

bool Region::contains(const Vec3& p) const {
  if (rings_.empty()) return std::hypot(p.x() - middle_.x(), p.y() - middle_.y()) <= radius_;
  if (!(distance(p) == 0)) return false;
  bool inside = false;
  for (const auto& ring : rings_)
    for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
      const Vec3 &a = ring[i], &b = ring[j];
      if ((a.y() > p.y()) != (b.y() > p.y()) &&
          p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()))
        inside = !inside;
    }
  return inside;
}

Digest Region::digest() const {
  Hasher hasher;
  hasher.add(middle_.x()).add(middle_.y()).add(radius_);
  for (const auto& ring : rings_)
    for (const Vec3& p : ring) hasher.add(p.x()).add(p.y());
  return hasher.digest();
}

double Region::distance(const Vec3& p) const {
  if (rings_.empty())
    return std::max(0.0, std::hypot(p.x() - middle_.x(), p.y() - middle_.y()) - radius_);
  const double dx = std::max({low_.x() - p.x(), 0.0, p.x() - high_.x()});
  const double dy = std::max({low_.y() - p.y(), 0.0, p.y() - high_.y()});
  return std::hypot(dx, dy);
}

}  // namespace cambium::monitor
