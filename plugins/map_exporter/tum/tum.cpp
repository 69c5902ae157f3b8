// SPDX-License-Identifier: BSD-3-Clause
#include "cambium/files.hpp"
#include "cambium/plugin.hpp"
#include "common/stamped_rows.hpp"

namespace {

using namespace cambium;

class TumExporter final : public MapExporter {
 public:
  std::vector<std::filesystem::path> write(const Atlas& atlas, const std::filesystem::path& folder,
                                           const Context& context) const override {
    std::vector<std::filesystem::path> written;
    for (const MissionState& state : atlas.missions) {
      context.check_cancelled();
      const auto poses = map_export::stamped_rows(state, "the TUM file", context);
      written.push_back(folder / (state.mission->name + ".tum"));
      write_file(written.back(), format_tum(poses));
    }
    return written;
  }
};

}  // namespace

CAMBIUM_PLUGIN("tum", "0.1.0") {
  registry.add<TumExporter>("tum",
                            "One trajectory per mission in the map frame, for evo and others");
}
