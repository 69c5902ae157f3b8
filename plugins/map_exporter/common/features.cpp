// SPDX-License-Identifier: BSD-3-Clause
#include "common/features.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

namespace cambium::map_export {
namespace {

constexpr auto integer = FieldType::integer;
constexpr auto real = FieldType::real;
constexpr auto text = FieldType::text;
constexpr auto point_in_time = FieldType::time;

Value known(double value) { return std::isfinite(value) ? Value(value) : Value(); }
Value known(const std::string& value) { return value.empty() ? Value() : Value(value); }
Value known(const std::optional<Stamp>& stamp) { return stamp ? Value(*stamp) : Value(); }
Value count(std::size_t value) { return std::int64_t(value); }

Layer tracks(const Atlas& atlas) {
  Layer out{"tracks",
            true,
            {{"mission", text},
             {"platform", integer},
             {"island", integer},
             {"nodes", integer},
             {"length", real, 1},
             {"first", point_in_time},
             {"last", point_in_time}},
            {}};
  for (const MissionState& state : atlas.missions) {
    const Mission& mission = *state.mission;
    if (mission.nodes.empty()) continue;
    Feature track{state.island, {}, {}};
    double length = 0;
    for (const SE3& T_map_node : *state.T_map_node) {
      if (!track.points.empty()) length += (T_map_node.t - track.points.back()).norm();
      track.points.push_back(T_map_node.t);
    }
    track.values = {mission.name,
                    std::int64_t(mission.platform_id),
                    count(state.island),
                    count(mission.nodes.size()),
                    length,
                    known(mission.nodes.front().stamp),
                    known(mission.nodes.back().stamp)};
    out.features.push_back(std::move(track));
  }
  return out;
}

Layer nodes(const Atlas& atlas) {
  Layer out{"nodes",
            false,
            {{"mission", text},
             {"node", integer},
             {"island", integer},
             {"sec", integer},
             {"nsec", integer},
             {"time", point_in_time},
             {"heading", real, 2}},
            {}};
  for (const MissionState& state : atlas.missions)
    for (std::size_t n = 0; n < state.mission->nodes.size(); ++n) {
      const Node& node = state.mission->nodes[n];
      const SE3& T = (*state.T_map_node)[n];
      Value sec, nsec;
      if (node.stamp) sec = node.stamp->sec, nsec = std::int64_t(node.stamp->nsec);
      out.features.push_back({state.island,
                              {T.t},
                              {state.mission->name, node.id, count(state.island), sec, nsec,
                               known(node.stamp), T.yaw() * 180 / M_PI}});
    }
  return out;
}

/// "overlap=0.8;rmse=0.05"
std::string scores_of(const Loop& loop) {
  std::string out;
  for (const auto& [name, value] : loop.scores) {
    char figure[40];
    std::snprintf(figure, sizeof figure, "%.4g", value);
    out += (out.empty() ? "" : ";") + name + "=" + figure;
  }
  return out;
}

Layer loops(const Atlas& atlas) {
  Layer out{"loops",
            true,
            {{"tail_mission", text},
             {"tail_node", integer},
             {"head_mission", text},
             {"head_node", integer},
             {"island", integer},
             {"verdict", text},
             {"proposed_by", text},
             {"registered_by", text},
             {"decided_by", text},
             {"reason", text},
             {"weight", real, 3},
             {"residual", real, 4},
             {"residual_angle", real, 4},
             {"scores", text}},
            {}};
  for (const Loop& loop : atlas.loops) {
    const std::uint32_t island = atlas.missions[loop.tail.mission].island;
    if (island != atlas.missions[loop.head.mission].island) continue;
    Value weight, shift, angle;
    if (loop.state == LoopState::accepted) {
      weight = loop.weight;
      shift = loop.residual.head<3>().norm();
      angle = loop.residual.tail<3>().norm() * 180 / M_PI;
    }
    out.features.push_back(
        {island,
         {atlas.T_map_node(loop.tail).t, atlas.T_map_node(loop.head).t},
         {atlas.mission(loop.tail).name, atlas.node(loop.tail).id, atlas.mission(loop.head).name,
          atlas.node(loop.head).id, count(island), std::string(to_string(loop.state)),
          known(loop.proposed_by), known(loop.registered_by), known(loop.decided_by),
          known(loop.reason), weight, shift, angle, known(scores_of(loop))}});
  }
  return out;
}

Layer stems(const Atlas& atlas, const StemOptions& options, const Context& context) {
  Layer out = stem_layer();
  for (std::size_t i = 0; i < atlas.islands.size(); ++i)
    for (const Stem& stem : stems_of(atlas, atlas.islands[i].missions, options, context))
      out.features.push_back(stem_feature(atlas, out.features.size() + 1, i, stem));
  return out;
}

}  // namespace

void LayerOptions::params(ParamVisitor& v) {
  v("layers", layers, "What to write", one_of({"tracks", "nodes", "loops", "stems"}));
  v("radius", stems.radius, "Detections so near each other are one tree", above(0, "m"));
  v("min_sightings", stems.min_sightings, "A tree was detected at so many nodes", between(1, 1e6));
  v("only_reconstructed", stems.only_reconstructed, "Leave out detections without a stem model");
}

std::vector<Layer> layers_of(const Atlas& atlas, const LayerOptions& options,
                             const Context& context) {
  const auto wanted = [&](const char* name) {
    return std::find(options.layers.begin(), options.layers.end(), name) != options.layers.end();
  };
  std::vector<Layer> out;
  const auto add = [&](Layer layer) {
    if (!layer.features.empty()) out.push_back(std::move(layer));
  };
  if (wanted("tracks")) add(tracks(atlas));
  if (wanted("nodes")) add(nodes(atlas));
  if (wanted("loops")) add(loops(atlas));
  if (wanted("stems")) add(stems(atlas, options.stems, context));
  return out;
}

Layer stem_layer() {
  return {"stems",
          false,
          {{"id", integer},
           {"island", integer},
           {"dbh", real, 4},
           {"dbh_spread", real, 4},
           {"dbh_sigma", real, 4},
           {"position_spread", real, 3},
           {"score", real, 3},
           {"sightings", integer},
           {"missions", text}},
          {}};
}

Feature stem_feature(const Atlas& atlas, std::size_t id, std::size_t island, const Stem& stem) {
  return {island,
          {stem.base},
          {count(id), count(island), known(stem.dbh), known(stem.dbh_spread), known(stem.dbh_sigma),
           known(stem.base_spread.head<2>().norm()), known(stem.score), count(stem.seen_by.size()),
           missions_of(atlas, stem)}};
}

std::string missions_of(const Atlas& atlas, const Stem& stem) {
  std::string out;
  for (const std::uint32_t m : stem.missions())
    out += (out.empty() ? "" : ";") + atlas.missions[m].mission->name;
  return out;
}

}  // namespace cambium::map_export
