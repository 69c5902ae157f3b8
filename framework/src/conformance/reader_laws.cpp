// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "cambium/files.hpp"
#include "conformance/law.hpp"

namespace cambium::conformance {
namespace {

namespace fs = std::filesystem;

// What a reader makes of something that is hardly its format: a mission, or a refusal that names
// the place.
std::string read(const Subject& s, const fs::path& path, const Context& context) {
  const auto& reader = s.as<MissionReader>();
  if (!reader.accepts(path)) return "not accepted";
  try {
    const Mission mission = reader.read(path, context);
    for (const Node& node : mission.nodes)
      require(node.T_mission_node.finite(),
              fmt::format("node {} has a pose that is not finite", node.id));
    return fmt::format("{} nodes", mission.nodes.size());
  } catch (const Error& e) {
    require(e.code() == ErrorCode::data,
            fmt::format("refuses bad data with exit code {}; expected {}", int(e.code()),
                        int(ErrorCode::data)));
    require(!e.where().empty(), fmt::format("refuses bad data without saying where: {}", e.what()));
    return "refused";
  }
}

Call on_file(const Subject& s, std::string name, std::string content) {
  return [&s, name, content](const Context& c) {
    const fs::path folder = c.scratch() / "conformance_reader";
    fs::create_directories(folder);
    write_file(folder / name, content);
    return read(s, folder / name, c) + read(s, folder, c);
  };
}

void refuses_what_is_not_there(const Subject& s) {
  const Host host(1);
  const auto context = host.context();
  const fs::path path = context->scratch() / "conformance_nothing" / "here";
  if (!s.as<MissionReader>().accepts(path)) return;
  try {
    s.as<MissionReader>().read(path, *context);
  } catch (const Error&) {
    return;
  }
  throw Broken("reads a mission from a path that does not exist");
}

}  // namespace

Exercise exercise_reader(const Subject& s) {
  Exercise e;
  e.usual = on_file(s, "slam_pose_graph.g2o",
                    "VERTEX_SE3:QUAT_TIME 0 0 0 0 0 0 0 1 10 0\n"
                    "VERTEX_SE3:QUAT_TIME 1 1 0 0 0 0 0 1 11 0\n");
  for (const char* name : {"slam_pose_graph.g2o", "poses.tum", "map.las", "recording.bag"}) {
    e.odd.emplace_back(fmt::format("an empty {}", name), on_file(s, name, ""));
    e.odd.emplace_back(fmt::format("a {} of random bytes", name),
                       on_file(s, name, std::string("\x7f\0\xff\x01garbage \n\n nan nan", 22)));
  }
  e.own = {{"refuses a path that does not exist", refuses_what_is_not_there}};
  return e;
}

}  // namespace cambium::conformance
