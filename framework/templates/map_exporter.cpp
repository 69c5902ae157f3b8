// SPDX-License-Identifier: BSD-3-Clause
// Writes one CSV table of all node positions. Replace write() by your format; what to keep to:
// docs/write-a-plugin.md.
#include <limits>

#include "cambium/files.hpp"
#include "cambium/plugin.hpp"

using namespace cambium;

class MyMethod final : public MapExporter {
 public:
  void params(ParamVisitor& v) override {
    v("file", file_, "Name of the file in the export's folder");
  }

  std::vector<std::filesystem::path> write(const Atlas& atlas, const std::filesystem::path& folder,
                                           const Context& context) const override {
    AtomicFile file(folder / file_);  // whole or absent, also after a kill or on a full disk
    file.stream().precision(std::numeric_limits<double>::max_digits10);
    file.stream() << "mission,id,x,y,z\n";
    for (const MissionState& state : atlas.missions) {
      context.check_cancelled();
      for (std::size_t i = 0; i < state.mission->nodes.size(); ++i) {
        const Vec3& p = (*state.T_map_node)[i].t;
        file.stream() << state.mission->name << ',' << state.mission->nodes[i].id << ',' << p.x()
                      << ',' << p.y() << ',' << p.z() << '\n';
      }
    }
    file.commit();
    return {folder / file_};
  }

 private:
  std::string file_ = "nodes.csv";
};

CAMBIUM_PLUGIN("my_method", "0.1.0") {
  registry.add<MyMethod>("my_method", "A table of all node positions");
}
