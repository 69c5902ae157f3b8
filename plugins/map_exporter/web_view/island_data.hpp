// SPDX-License-Identifier: BSD-3-Clause
// One pass over what the nodes of an island saw.
#pragma once
#include "cambium/context.hpp"
#include "map_json.hpp"

namespace web_view {

struct Settings {
  double voxel_size = 0.03;
  int tile_points = 20000, pair_points = 6000, stem_sightings = 3;
  bool images = true;
};

/// Files are written below `folder` and named in `files`.
struct Output {
  std::filesystem::path folder;
  std::vector<std::filesystem::path> files;
  void write(const std::string& name, const std::string& bytes);
};

/// Writes the tiles of an island to tiles/<island>/ and the clouds of its loops' ends to pairs/.
/// The first picture of each node goes to images/. Returns its entry in map.json and appends to the
/// map's "stems" and "images" (rows of node, file).
Json write_island(const cambium::Atlas& atlas, std::size_t island, const Settings& settings,
                  const cambium::Context& context, Output& output, Json& stems, Json& images);

}  // namespace web_view
