// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>

#include "cambium/dialect.hpp"
#include "cambium/files.hpp"
#include "cambium/plugin.hpp"

namespace {

using namespace cambium;

std::string matrix_row(const SE3& T) {
  const Mat4 M = T.matrix();
  std::string out;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 4; ++c) out += (r + c ? " " : "") + format_number(M(r, c));
  return out + "\n";
}

/// Empty when a node has no stamp: lines must stand beside those of the poses.
std::string times_of(const Mission& mission) {
  std::string out;
  for (const Node& node : mission.nodes) {
    if (!node.stamp) return {};
    char text[64];
    std::snprintf(text, sizeof text, "%lld.%09d\n", static_cast<long long>(node.stamp->sec),
                  int(node.stamp->nsec));
    out += text;
  }
  return out;
}

class KittiExporter final : public MapExporter {
 public:
  std::vector<std::filesystem::path> write(const Atlas& atlas, const std::filesystem::path& folder,
                                           const Context& context) const override {
    std::vector<std::filesystem::path> written;
    for (const MissionState& state : atlas.missions) {
      context.check_cancelled();
      std::string poses;
      for (const SE3& T_map_node : *state.T_map_node) poses += matrix_row(T_map_node);
      written.push_back(folder / (state.mission->name + ".kitti"));
      write_file(written.back(), poses);
      const std::string times = times_of(*state.mission);
      if (times.empty()) {
        context.warn(state.mission->name + ": a node has no stamp, so there is no .times file");
        continue;
      }
      written.push_back(folder / (state.mission->name + ".times"));
      write_file(written.back(), times);
    }
    return written;
  }
};

}  // namespace

CAMBIUM_PLUGIN("kitti", "0.1.0") {
  registry.add<KittiExporter>("kitti",
                              "One trajectory per mission as 3x4 matrices, with stamps beside it");
}
