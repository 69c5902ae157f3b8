// SPDX-License-Identifier: BSD-3-Clause
#include "cambium/files.hpp"
#include "cambium/fused.hpp"
#include "cambium/plugin.hpp"

namespace {

using namespace cambium;

class TumExporter final : public MapExporter {
 public:
  std::vector<std::filesystem::path> write(const Atlas& atlas, const std::filesystem::path& folder,
                                           const Context& context) const override {
    std::vector<std::filesystem::path> written;
    for (const MissionState& state : atlas.missions) {
      context.check_cancelled();
      const auto poses = trajectory(state);
      const std::size_t without = state.mission->nodes.size() - poses.size();
      if (without > 0)
        context.warn(state.mission->name + ": " + std::to_string(without) +
                     " nodes have no stamp, so the TUM file has no row for them");
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
