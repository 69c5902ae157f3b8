// SPDX-License-Identifier: BSD-3-Clause
#include "cambium/dialect.hpp"
#include "cambium/files.hpp"
#include "cambium/plugin.hpp"
#include "common/stamped_rows.hpp"

namespace {

using namespace cambium;

std::string table(const std::vector<StampedPose>& poses) {
  std::string out =
      "#timestamp [ns],p_RS_R_x [m],p_RS_R_y [m],p_RS_R_z [m],"
      "q_RS_w [],q_RS_x [],q_RS_y [],q_RS_z []\n";
  for (const auto& [stamp, T] : poses) {
    out += std::to_string(stamp.sec * 1'000'000'000 + stamp.nsec);
    for (const double v : T.t) out += ',' + format_number(v);
    for (const double v : {T.q.w(), T.q.x(), T.q.y(), T.q.z()}) out += ',' + format_number(v);
    out += '\n';
  }
  return out;
}

class EurocExporter final : public MapExporter {
 public:
  std::vector<std::filesystem::path> write(const Atlas& atlas, const std::filesystem::path& folder,
                                           const Context& context) const override {
    std::vector<std::filesystem::path> written;
    for (const MissionState& state : atlas.missions) {
      context.check_cancelled();
      const auto poses = map_export::stamped_rows(state, "EuRoC's table", context);
      if (poses.empty()) continue;
      const auto place = folder / state.mission->name / "mav0" / "state_groundtruth_estimate0";
      std::filesystem::create_directories(place);
      written.push_back(place / "data.csv");
      write_file(written.back(), table(poses));
    }
    return written;
  }
};

}  // namespace

CAMBIUM_PLUGIN("euroc", "0.1.0") {
  registry.add<EurocExporter>("euroc", "One trajectory per mission as EuRoC's ground truth");
}
