// SPDX-License-Identifier: BSD-3-Clause
#include "tile_payload.hpp"

#include "cambium/error.hpp"
#include "common/las_points.hpp"

namespace las_tiles {

using namespace cambium;

Payload TilePayload::load() const {
  constexpr double farthest = 1e5;  // [m], where a float's step is 8 mm
  const ToMission to_mission(frame_);
  Cloud cloud;
  cloud.xyz.reserve(3 * header_.points);
  cloud.intensity.reserve(header_.points);
  cloud.label.reserve(header_.points);
  bool labelled = false;
  las::for_each_point(path_, header_, [&](const las::Point& stored) {
    Vec3 p;
    try {
      p = to_mission({stored.x, stored.y, stored.z}) - t_mission_node_;
    } catch (const Error& error) {
      throw Error(ErrorCode::data, path_.string(), error.message());
    }
    if (!(p.cwiseAbs().maxCoeff() < farthest))
      throw Error(ErrorCode::data, path_.string(),
                  "has a point more than 100 km from the middle of the extent in its header; that "
                  "extent, or the point, is wrong");
    for (const double v : p) cloud.xyz.push_back(float(v));
    cloud.intensity.push_back(float(stored.intensity));
    cloud.label.push_back(stored.classification);
    labelled = labelled || stored.classification != 0;
  });
  if (!labelled) cloud.label = {};
  return {std::make_shared<const Cloud>(std::move(cloud)), nullptr};
}

Digest TilePayload::digest() const {
  std::call_once(digest_once_, [this] {
    Hasher hasher;
    hasher.add("las tile 1").add(digest_file(path_)).add(frame_.crs);
    for (const double v : frame_.origin) hasher.add(v);
    for (const double v : t_mission_node_) hasher.add(v);
    digest_ = hasher.digest();
  });
  return digest_;
}

}  // namespace las_tiles
