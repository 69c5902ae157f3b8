// SPDX-License-Identifier: BSD-3-Clause
#include "cambium/dialect.hpp"
#include "cambium/files.hpp"
#include "cambium/fused.hpp"
#include "cambium/plugin.hpp"

namespace {

using namespace cambium;

class G2oExporter final : public MapExporter {
 public:
  std::vector<std::filesystem::path> write(const Atlas& atlas, const std::filesystem::path& folder,
                                           const Context& context) const override {
    std::vector<std::filesystem::path> written;
    for (std::size_t i = 0; i < atlas.islands.size(); ++i) {
      context.check_cancelled();
      written.push_back(folder / island_file("fused", i, ".g2o"));
      AtomicFile file(written.back());
      write_g2o(file.stream(), fused_mission(atlas, atlas.islands[i]));
      file.commit();
    }
    return written;
  }
};

}  // namespace

CAMBIUM_PLUGIN("g2o", "0.1.0") {
  registry.add<G2oExporter>("g2o", "All missions of an island as one pose graph");
}
