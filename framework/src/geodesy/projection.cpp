// SPDX-License-Identifier: BSD-3-Clause
#include "cambium/projection.hpp"

#include <proj.h>
#include <proj_experimental.h>  // proj_crs_promote_to_3D

#include <algorithm>
#include <cmath>

#include "cambium/error.hpp"

namespace cambium {

struct Projection::Handles {
  PJ_CONTEXT* context = proj_context_create();
  PJ* asked = nullptr;   // as the user named it
  PJ* target = nullptr;  // with heights
  PJ* transform = nullptr;

  ~Handles() {
    proj_destroy(transform);
    proj_destroy(asked);
    proj_destroy(target);
    proj_context_destroy(context);
  }
};

namespace {

/// A plane system without heights gets ellipsoidal ones, so that they pass unchanged.
PJ* with_heights(PJ_CONTEXT* context, PJ* crs, std::string& heights) {
  if (proj_get_type(crs) == PJ_TYPE_COMPOUND_CRS) {
    if (PJ* vertical = proj_crs_get_sub_crs(context, crs, 1)) {
      heights = proj_get_name(vertical);
      proj_destroy(vertical);
    }
    return crs;
  }
  PJ* promoted = proj_crs_promote_to_3D(context, nullptr, crs);
  if (!promoted) return crs;
  proj_destroy(crs);
  return promoted;
}

PJ_TYPE horizontal_type(PJ_CONTEXT* context, const PJ* crs) {
  if (proj_get_type(crs) != PJ_TYPE_COMPOUND_CRS) return proj_get_type(crs);
  PJ* horizontal = proj_crs_get_sub_crs(context, crs, 0);
  const PJ_TYPE type = horizontal ? proj_get_type(horizontal) : PJ_TYPE_UNKNOWN;
  proj_destroy(horizontal);
  return type;
}

}  // namespace

Projection::Projection(const std::string& crs) : handles_(new Handles), crs_(crs) {
  PJ_CONTEXT* context = handles_->context;
  proj_log_level(context, PJ_LOG_NONE);  // errors are told below
  handles_->target = proj_create(context, crs.c_str());
  if (!handles_->target || !proj_is_crs(handles_->target))
    throw Error(ErrorCode::config, "crs",
                "PROJ knows no coordinate reference system '" + crs +
                    "'; expected a code such as EPSG:32635, or EPSG:32635+5773 with a geoid");
  handles_->asked = proj_clone(context, handles_->target);
  handles_->target = with_heights(context, handles_->target, heights_);
  name_ = proj_get_name(handles_->target);
  const PJ_TYPE type = horizontal_type(context, handles_->target);
  plane_ = type == PJ_TYPE_PROJECTED_CRS;
  if (!plane_ && type != PJ_TYPE_GEOGRAPHIC_2D_CRS && type != PJ_TYPE_GEOGRAPHIC_3D_CRS)
    throw Error(ErrorCode::config, "crs",
                "'" + crs + "' (" + name_ + ") is neither a projected nor a geographic system");
  PJ* source = proj_create(context, "EPSG:4979");  // WGS 84 with ellipsoidal heights
  // A ballpark transformation would leave heights where they are, as if there were no geoid.
  const char* const options[] = {"ALLOW_BALLPARK=NO", nullptr};
  PJ* transform =
      proj_create_crs_to_crs_from_pj(context, source, handles_->target, nullptr, options);
  proj_destroy(source);
  if (transform) handles_->transform = proj_normalize_for_visualization(context, transform);
  proj_destroy(transform);
  if (!handles_->transform)
    throw Error(ErrorCode::config, "crs",
                "PROJ has no exact way from WGS 84 to '" + crs +
                    "'; is the grid of its geoid installed (projsync --list-files)?");
}

Projection::~Projection() = default;

Vec3 Projection::operator()(const Geodetic& place) const {
  const PJ_COORD out = proj_trans(handles_->transform, PJ_FWD,
                                  proj_coord(place.longitude, place.latitude, place.altitude, 0));
  const Vec3 p(out.xyz.x, out.xyz.y, out.xyz.z);
  if (p.allFinite()) return p;
  throw Error(ErrorCode::numeric, "crs",
              "latitude " + std::to_string(place.latitude) + ", longitude " +
                  std::to_string(place.longitude) + " has no place in " + crs_ + " (" + name_ +
                  "); choose a system that covers it, with its grids installed");
}

Geodetic Projection::inverse(const Vec3& place) const {
  const PJ_COORD out =
      proj_trans(handles_->transform, PJ_INV, proj_coord(place.x(), place.y(), place.z(), 0));
  const Geodetic g{out.xyz.y, out.xyz.x, out.xyz.z};
  if (std::isfinite(g.latitude) && std::isfinite(g.longitude) && std::isfinite(g.altitude))
    return g;
  throw Error(ErrorCode::numeric, "crs",
              "(" + std::to_string(place.x()) + ", " + std::to_string(place.y()) +
                  ") is no place of " + crs_ + " (" + name_ + ")");
}

void Projection::require_plane() const {
  if (!plane_)
    throw Error(ErrorCode::config, "crs",
                "'" + crs_ + "' (" + name_ +
                    ") counts in degrees, expected a projected system, "
                    "such as EPSG:32635");
}

std::string Projection::wkt() const {
  // GDAL's dialect of the first version is the one that readers of LAS files know.
  const char* text = proj_as_wkt(handles_->context, handles_->asked, PJ_WKT1_GDAL, nullptr);
  if (text) return text;
  throw Error(ErrorCode::config, "crs",
              "'" + crs_ + "' (" + name_ + ") cannot be written as well-known text of version 1");
}

std::string utm_zone(double latitude, double longitude) {
  const int zone = std::clamp(int(std::floor((longitude + 180) / 6)) + 1, 1, 60);
  return "EPSG:" + std::to_string((latitude < 0 ? 32700 : 32600) + zone);
}

}  // namespace cambium
