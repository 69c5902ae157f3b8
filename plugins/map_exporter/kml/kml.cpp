// SPDX-License-Identifier: BSD-3-Clause
#include <sstream>

#include "cambium/files.hpp"
#include "cambium/fused.hpp"
#include "cambium/plugin.hpp"
#include "kml_writer.hpp"
#include "zip_file.hpp"

namespace kml {

using namespace cambium;

class KmlExporter final : public MapExporter {
 public:
  void params(ParamVisitor& v) override {
    v("altitude_mode", altitude_mode_,
      "clampToGround drapes the tracks over the viewer's terrain, absolute uses their altitudes",
      one_of({"clampToGround", "absolute"}));
    v("loops", loops_, "Draw accepted loops as lines");
    v("time_slider", time_slider_,
      "Tracks know the time of each node (gx:Track), for viewers with a time slider");
    v("format", format_, "kmz: the same in a ZIP archive, one file to send",
      one_of({"kml", "kmz"}));
  }

  std::vector<std::filesystem::path> write(const Atlas& atlas, const std::filesystem::path& folder,
                                           const Context& context) const override {
    std::ostringstream out;
    out << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
           "<kml xmlns=\"http://www.opengis.net/kml/2.2\" "
           "xmlns:gx=\"http://www.google.com/kml/ext/2.2\"><Document><name>Cambium</name>\n";
    write_styles(out);
    std::size_t islands = 0;
    for (std::size_t i = 0; i < atlas.islands.size(); ++i) {
      context.check_cancelled();
      islands += write_island(out, atlas, i, context);
    }
    out << "</Document></kml>\n";
    if (islands == 0) return {};
    const auto path = folder / ("tracks." + format_);
    write_file(path, format_ == "kmz" ? zip_of("doc.kml", out.str()) : out.str());
    return {path};
  }

 private:
  bool write_island(std::ostream& out, const Atlas& atlas, std::size_t i,
                    const Context& context) const {
    const Island& island = atlas.islands[i];
    const auto tie = georeference(atlas, island);
    if (!tie) {
      context.warn("island " + std::to_string(i) + " (mission " +
                   atlas.missions[island.missions.front()].mission->name +
                   (island.missions.size() > 1 ? ", ..." : "") +
                   ") has no georeference and is not in the KML; add a georeference step");
      return false;
    }
    out << "<Folder><name>island " << i << "</name>\n";
    Writer writer(out, atlas, *tie, altitude_mode_);
    for (const std::uint32_t m : island.missions)
      if (!time_slider_ || !writer.moving_track(m)) writer.track(m);
    for (const Loop& loop : atlas.loops)
      if (loops_ && loop.state == LoopState::accepted &&
          atlas.missions[loop.tail.mission].island == i)
        writer.loop(loop);
    out << "</Folder>\n";
    return true;
  }

  std::string altitude_mode_ = "clampToGround";
  bool loops_ = true;
  bool time_slider_ = false;
  std::string format_ = "kml";
};

}  // namespace kml

CAMBIUM_PLUGIN("kml", "0.1.0") {
  registry.add<kml::KmlExporter>("kml", "Tracks and loops on the globe, for Google Earth and GIS");
}
