// SPDX-License-Identifier: BSD-3-Clause
#include "inspect_report.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "cambium/path.hpp"

namespace cambium::cli {
namespace {

double span(const Inspection& i) { return i.first ? seconds_between(*i.first, *i.last) : 0; }

std::string counts(const std::map<std::string, std::size_t>& by_name) {
  std::string out;
  for (const auto& [name, count] : by_name)
    out += fmt::format("{}{} {}", out.empty() ? "" : ", ", count, name);
  return out.empty() ? "none" : out;
}

std::string cloud_line(const PayloadFigures& p) {
  if (p.clouds == 0) return "none";
  return fmt::format("{} ({} empty), {} points, {} to {} each (median {:.0f}), up to {:.1f} m away",
                     p.clouds, p.empty_clouds, p.points, p.fewest_points, p.most_points,
                     p.median_points, p.farthest_point);
}

nlohmann::ordered_json payloads_json(const PayloadFigures& p) {
  return {{"clouds", p.clouds},
          {"empty_clouds", p.empty_clouds},
          {"points", p.points},
          {"fewest_points", p.fewest_points},
          {"median_points", p.median_points},
          {"most_points", p.most_points},
          {"farthest_point_m", p.farthest_point},
          {"tree_tables", p.tree_tables},
          {"trees", p.trees},
          {"unreadable", p.unreadable},
          {"bytes", p.bytes}};
}

nlohmann::ordered_json georeference_json(const Mission& mission) {
  if (!mission.georeference) return nullptr;
  const GeoReference& g = *mission.georeference;
  return {{"latitude", g.latitude}, {"longitude", g.longitude}, {"altitude", g.altitude}};
}

}  // namespace

std::string inspection_text(const Mission& mission, const Inspection& i) {
  const Vec3 size = i.high - i.low;
  std::string out;
  const auto row = [&out](const char* name, const std::string& value) {
    out += fmt::format("{:<14}{}\n", name, value);
  };
  row("mission", mission.name);
  row("pose graph", mission.graph_file.string());
  row("platform", std::to_string(mission.platform_id));
  row("nodes", fmt::format("{} ({} stamped, {} fixed)", i.nodes, i.stamped, i.fixed));
  row("edges", counts(i.edges));
  if (i.edges.contains("odometry"))
    row("", fmt::format("odometry is {:.3g} m from the poses (median), {:.3g} m at most",
                        i.median_odometry_residual, i.largest_odometry_residual));
  if (i.first)
    row("time", fmt::format("{}.{:09} to {}.{:09} ({:.1f} s)", i.first->sec, i.first->nsec,
                            i.last->sec, i.last->nsec, span(i)));
  row("path", fmt::format("{:.1f} m in a box of {:.1f} x {:.1f} x {:.1f} m", i.path_length,
                          size.x(), size.y(), size.z()));
  row("connected", i.parts == 1 ? "yes" : fmt::format("no, {} parts", i.parts));
  row("clouds", cloud_line(i.payloads));
  row("tree tables", i.payloads.tree_tables == 0
                         ? "none"
                         : fmt::format("{}, {} trees", i.payloads.tree_tables, i.payloads.trees));
  row("GNSS fixes", std::to_string(mission.fixes.size()));
  row("georeference",
      mission.georeference
          ? fmt::format("{:.7f} {:.7f} {:.2f}", mission.georeference->latitude,
                        mission.georeference->longitude, mission.georeference->altitude)
          : "none");
  row("other lines", counts(i.unknown_lines));
  out += fmt::format("\n{} warnings\n", i.findings.size());
  for (const std::string& finding : i.findings) out += fmt::format("  {}\n", finding);
  return out;
}

std::string inspection_json(const Mission& mission, const Inspection& i) {
  const auto vector = [](const Vec3& v) { return nlohmann::ordered_json{v.x(), v.y(), v.z()}; };
  const nlohmann::ordered_json json = {{"mission", mission.name},
                                       {"pose_graph", mission.graph_file.string()},
                                       {"platform", mission.platform_id},
                                       {"nodes", i.nodes},
                                       {"stamped", i.stamped},
                                       {"fixed", i.fixed},
                                       {"edges", i.edges},
                                       {"median_odometry_residual_m", i.median_odometry_residual},
                                       {"largest_odometry_residual_m", i.largest_odometry_residual},
                                       {"span_s", span(i)},
                                       {"path_length_m", i.path_length},
                                       {"low_m", vector(i.low)},
                                       {"high_m", vector(i.high)},
                                       {"parts", i.parts},
                                       {"payloads", payloads_json(i.payloads)},
                                       {"gnss_fixes", mission.fixes.size()},
                                       {"georeference", georeference_json(mission)},
                                       {"other_lines", i.unknown_lines},
                                       {"warnings", i.findings}};
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace cambium::cli
