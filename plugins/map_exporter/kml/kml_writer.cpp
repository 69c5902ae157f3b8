// SPDX-License-Identifier: BSD-3-Clause
#include "kml_writer.hpp"

#include <array>
#include <cstdio>

#include "cambium/geodesy.hpp"
#include "common/iso_time.hpp"

namespace kml {
namespace {

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else if (static_cast<unsigned char>(c) < 0x20 && c != '\t')
      out += '?';  // not allowed in XML
    else
      out += c;
  }
  return out;
}

/// aabbggrr. Okabe and Ito's colours, told apart by the colour-blind too.
constexpr std::array<const char*, 7> track_colours = {
    "ff009fe6", "ffe9b456", "ff739e00", "ff42e4f0", "ffb27200", "ff005ed5", "ffa779cc"};
constexpr const char* loop_colour = "99ffffff";

}  // namespace

using namespace cambium;

void write_styles(std::ostream& out) {
  const auto style = [&](const std::string& id, const char* colour, int width) {
    out << "<Style id=\"" << id << "\"><LineStyle><color>" << colour << "</color><width>" << width
        << "</width></LineStyle></Style>\n";
  };
  for (std::size_t i = 0; i < track_colours.size(); ++i)
    style("track_" + std::to_string(i), track_colours[i], 3);
  style("loop", loop_colour, 1);
}

void Writer::track(std::uint32_t mission) {
  const MissionState& state = atlas_.missions[mission];
  begin_line(state.mission->name, "track_" + std::to_string(mission % track_colours.size()));
  for (const SE3& T_map_node : *state.T_map_node) point(T_map_node.t);
  end_line();
}

bool Writer::moving_track(std::uint32_t mission) {
  const MissionState& state = atlas_.missions[mission];
  std::string times, places;
  std::size_t count = 0;
  for (std::size_t i = 0; i < state.T_map_node->size(); ++i) {
    const auto& stamp = state.mission->nodes[i].stamp;
    if (!stamp) continue;
    const Geodetic g = map_to_geodetic(georeference_, (*state.T_map_node)[i].t);
    char text[112];
    std::snprintf(text, sizeof text, "<gx:coord>%.9f %.9f %.3f</gx:coord>\n", g.longitude,
                  g.latitude, g.altitude);
    times += "<when>" + map_export::iso_time(*stamp) + "</when>\n";
    places += text;
    ++count;
  }
  if (count < 2) return false;
  out_ << "<Placemark><name>" << escaped(state.mission->name) << "</name><styleUrl>#track_"
       << mission % track_colours.size() << "</styleUrl><gx:Track><altitudeMode>" << altitude_mode_
       << "</altitudeMode>\n"
       << times << places << "</gx:Track></Placemark>\n";
  return true;
}

void Writer::loop(const Loop& loop) {
  begin_line(name(loop.tail) + " - " + name(loop.head), "loop");
  point(atlas_.T_map_node(loop.tail).t);
  point(atlas_.T_map_node(loop.head).t);
  end_line();
}

std::string Writer::name(NodeRef n) const {
  return atlas_.mission(n).name + " " + std::to_string(atlas_.node(n).id);
}

void Writer::begin_line(const std::string& name, const std::string& style) {
  out_ << "<Placemark><name>" << escaped(name) << "</name><styleUrl>#" << style
       << "</styleUrl><LineString><tessellate>1</tessellate><altitudeMode>" << altitude_mode_
       << "</altitudeMode><coordinates>\n";
}

void Writer::point(const Vec3& p_map) {
  const Geodetic g = map_to_geodetic(georeference_, p_map);
  char text[96];  // 1e-9 deg is 0.1 mm
  std::snprintf(text, sizeof text, "%.9f,%.9f,%.3f\n", g.longitude, g.latitude, g.altitude);
  out_ << text;
}

void Writer::end_line() { out_ << "</coordinates></LineString></Placemark>\n"; }

}  // namespace kml
