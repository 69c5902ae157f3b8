// SPDX-License-Identifier: BSD-3-Clause
#include "file_system.hpp"

#include "cambium/error.hpp"
#include "common/las_header.hpp"

namespace las_tiles {

using namespace cambium;

ToMission::ToMission(const Frame& frame) : frame_(frame) {
  if (frame.crs.empty()) return;
  projection_.emplace(frame.crs);
  reference_ = projection_->inverse(frame.origin);
}

Vec3 ToMission::operator()(const Vec3& p_file) const {
  if (!projection_) return p_file - frame_.origin;
  return to_enu(reference_, projection_->inverse(p_file));
}

std::optional<GeoReference> ToMission::georeference() const {
  if (!projection_) return std::nullopt;
  return GeoReference{reference_.latitude, reference_.longitude, reference_.altitude, SE3{}, 0, 0};
}

std::string usable_crs(const std::string& crs, const Vec3& place, const std::string& file,
                       std::vector<std::string>& warnings) {
  std::string why;
  try {
    // Some systems are known until a point is to be mapped: then their grid is missed.
    Projection(crs).inverse(place);
    return crs;
  } catch (const Error& error) {
    why = error.message().substr(0, 300);
  }
  const std::string plane = las::horizontal_part(crs);
  if (plane != crs) try {
      const Projection projection(plane);
      projection.inverse(place);
      warnings.push_back(file + ": the grid of the geoid that its heights are above is not " +
                         "installed; they are taken as heights above the ellipsoid (" +
                         projection.name() +
                         "), so that the whole map stands too low or too high by up to 100 m");
      return plane;
    } catch (const Error&) {
    }
  throw Error(ErrorCode::data, file,
              "its coordinate reference system is of no use: " + why +
                  "; name the right one by the reader's parameter crs");
}

}  // namespace las_tiles
