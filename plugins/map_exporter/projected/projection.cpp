// SPDX-License-Identifier: BSD-3-Clause
#include "projection.hpp"

#include <proj.h>
#include <proj_experimental.h>  // proj_crs_promote_to_3D

#include "cambium/error.hpp"

namespace projected {

using cambium::Error;
using cambium::ErrorCode;

struct Projection::Handles {
  PJ_CONTEXT* context = proj_context_create();
  PJ* target = nullptr;
  PJ* transform = nullptr;

  ~Handles() {
    proj_destroy(transform);
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

bool is_plane(PJ_CONTEXT* context, const PJ* crs) {
  if (proj_get_type(crs) != PJ_TYPE_COMPOUND_CRS)
    return proj_get_type(crs) == PJ_TYPE_PROJECTED_CRS;
  PJ* horizontal = proj_crs_get_sub_crs(context, crs, 0);
  const bool plane = horizontal && proj_get_type(horizontal) == PJ_TYPE_PROJECTED_CRS;
  proj_destroy(horizontal);
  return plane;
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
  handles_->target = with_heights(context, handles_->target, heights_);
  name_ = proj_get_name(handles_->target);
  if (!is_plane(context, handles_->target))
    throw Error(
        ErrorCode::config, "crs",
        "'" + crs + "' (" + name_ + ") is no projected system; export: geojson writes degrees");
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

cambium::Vec3 Projection::operator()(const cambium::Geodetic& place) const {
  const PJ_COORD out = proj_trans(handles_->transform, PJ_FWD,
                                  proj_coord(place.longitude, place.latitude, place.altitude, 0));
  const cambium::Vec3 p(out.xyz.x, out.xyz.y, out.xyz.z);
  if (p.allFinite()) return p;
  throw Error(ErrorCode::numeric, "crs",
              "latitude " + std::to_string(place.latitude) + ", longitude " +
                  std::to_string(place.longitude) + " has no place in " + crs_ + " (" + name_ +
                  "); choose a system that covers it, with its grids installed");
}

}  // namespace projected
