// SPDX-License-Identifier: BSD-3-Clause
// A plan of the map: where the missions went, and which loops hold them together.
#include <fmt/format.h>

#include "cambium/files.hpp"
#include "cambium/fused.hpp"
#include "cambium/plugin.hpp"
#include "drawing.hpp"

namespace plan {
namespace {

using namespace cambium;

// Okabe and Ito's colours, told apart by most colour-blind readers; green and red are for loops.
const char* colour_of(std::size_t mission) {
  static const char* const colours[] = {"#0072b2", "#e69f00", "#cc79a7", "#56b4e9",
                                        "#8c6d31", "#5b3fa0", "#222222"};
  return colours[mission % std::size(colours)];
}

class Plan final : public MapExporter {
 public:
  void params(ParamVisitor& v) override {
    v("width", width_, "Width of the picture in pixels", between(200, 10000));
    v("rejected", rejected_, "Draw rejected loops too, in red");
    v("odometry", odometry_, "Draw each mission as its robot estimated it too, dashed");
  }

  std::vector<std::filesystem::path> write(const Atlas& atlas, const std::filesystem::path& folder,
                                           const Context& context) const override {
    std::vector<std::filesystem::path> files;
    for (std::uint32_t i = 0; i < atlas.islands.size(); ++i) {
      context.check_cancelled();
      files.push_back(folder / island_file("plan", i, ".svg"));
      write_file(files.back(), draw(atlas, i));
    }
    return files;
  }

 private:
  // The robot's own estimate, placed where the mission begins in the map.
  static std::vector<Vec3> positions(const MissionState& state, bool odometry) {
    std::vector<Vec3> out;
    const SE3 T = T_map_mission(state);
    for (std::size_t i = 0; i < state.T_map_node->size(); ++i)
      out.push_back(odometry ? T * state.mission->nodes[i].T_mission_node.t
                             : (*state.T_map_node)[i].t);
    return out;
  }

  std::string draw(const Atlas& atlas, std::uint32_t index) const {
    const Island& island = atlas.islands[index];
    Box box;
    for (const auto m : island.missions)
      for (const bool odometry : {false, true})
        if (!odometry || odometry_)
          for (const Vec3& p : positions(atlas.missions[m], odometry)) box.include(p);
    Drawing drawing(box, width_);
    const std::size_t accepted = draw_loops(atlas, index, LoopState::accepted, "#009e73", drawing);
    const std::size_t rejected =
        rejected_ ? draw_loops(atlas, index, LoopState::rejected, "#d55e00", drawing) : 0;
    for (const auto m : island.missions) draw_mission(atlas.missions[m], m, drawing);
    drawing.legend(fmt::format("{} accepted loops", accepted), "#009e73");
    if (rejected_) drawing.legend(fmt::format("{} rejected loops", rejected), "#d55e00");
    drawing.scale_bar();
    return drawing.svg();
  }

  static std::size_t draw_loops(const Atlas& atlas, std::uint32_t island, LoopState state,
                                const char* colour, Drawing& drawing) {
    std::size_t count = 0;
    for (const Loop& loop : atlas.loops) {
      if (loop.state != state || atlas.missions[loop.tail.mission].island != island ||
          atlas.missions[loop.head.mission].island != island)
        continue;
      drawing.line(atlas.T_map_node(loop.tail).t, atlas.T_map_node(loop.head).t, colour, 1);
      ++count;
    }
    return count;
  }

  void draw_mission(const MissionState& state, std::size_t index, Drawing& drawing) const {
    if (odometry_) drawing.path(positions(state, true), colour_of(index), 1, true);
    const auto points = positions(state, false);
    drawing.path(points, colour_of(index), 2, false);
    for (const Vec3& p : points) drawing.dot(p, colour_of(index), 2.2);
    drawing.legend(fmt::format("{}, {} nodes", state.mission->name, points.size()),
                   colour_of(index));
  }

  int width_ = 800;
  bool rejected_ = false;
  bool odometry_ = true;
};

}  // namespace
}  // namespace plan

CAMBIUM_PLUGIN("plan", "0.1.0") {
  registry.add<plan::Plan>("plan", "Plan of trajectories and loops as a picture (SVG)");
}
