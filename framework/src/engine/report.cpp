// SPDX-License-Identifier: BSD-3-Clause
#include "engine/report.hpp"

#include <fmt/format.h>

#include <limits>

#include "engine/program.hpp"

namespace cambium {
namespace {

const char* to_string(Better better) {
  switch (better) {
    case Better::lower:
      return "lower";
    case Better::higher:
      return "higher";
    case Better::neither:
      break;
  }
  return "neither";
}

Json scores_json(const std::vector<Score>& scores) {
  Json out = Json::object();
  for (const auto& [name, value] : scores) out[name] = value;
  return out;
}

Json georeference_json(const GeoReference& g) {
  const auto& T = g.T_map_enu;
  return {{"latitude", g.latitude},
          {"longitude", g.longitude},
          {"altitude", g.altitude},
          {"T_map_enu", {T.t.x(), T.t.y(), T.t.z(), T.q.x(), T.q.y(), T.q.z(), T.q.w()}},
          {"sigma_yaw", g.sigma_yaw},
          {"sigma_position", g.sigma_position}};
}

Json missions_json(const Atlas& atlas) {
  Json out = Json::array();
  for (const auto& m : atlas.missions)
    out.push_back({{"name", m.mission->name},
                   {"folder", m.mission->folder.string()},
                   {"platform_id", m.mission->platform_id},
                   {"nodes", m.mission->nodes.size()},
                   {"edges", m.mission->edges.size()},
                   {"fixes", m.mission->fixes.size()},
                   {"island", m.island},
                   {"id_offset", m.id_offset},
                   {"warnings", m.mission->warnings.size()}});
  return out;
}

Json islands_json(const Atlas& atlas) {
  Json out = Json::array();
  for (const auto& island : atlas.islands) {
    Json names = Json::array();
    for (const auto m : island.missions) names.push_back(atlas.missions[m].mission->name);
    Json entry{{"missions", names}};
    entry["georeference"] =
        island.georeference ? georeference_json(*island.georeference) : Json(nullptr);
    out.push_back(entry);
  }
  return out;
}

Json step_json(const StepRecord& s) {
  Json key = Json::object();
  for (const auto& [part, value] : s.key) key[part] = value;
  Json files = Json::array();
  for (const auto& f : s.files) files.push_back(f.string());
  return {{"verb", s.verb},           {"plugin", s.plugin},
          {"label", s.label},         {"seconds", s.seconds},
          {"work_seconds", s.work},   {"items", s.items},
          {"cached_items", s.cached}, {"cached", s.items > 0 && s.items == s.cached},
          {"summary", s.summary},     {"figures", scores_json(s.figures)},
          {"files", files},           {"key", key}};
}

Json loop_json(const Atlas& atlas, const Loop& l) {
  const auto node = [&](NodeRef n) -> Json {
    return {{"mission", atlas.mission(n).name},
            {"id", atlas.node(n).id},
            {"fused_id", atlas.node(n).id + atlas.missions[n.mission].id_offset}};
  };
  Json out{{"tail", node(l.tail)},
           {"head", node(l.head)},
           {"state", to_string(l.state)},
           {"proposed_by", l.proposed_by},
           {"registered_by", l.registered_by},
           {"decided_by", l.decided_by},
           {"reason", l.reason},
           {"scores", scores_json(l.scores)}};
  const auto& T = l.T_tail_head;
  if (has_transform(l))
    out["T_tail_head"] = {T.t.x(), T.t.y(), T.t.z(), T.q.x(), T.q.y(), T.q.z(), T.q.w()};
  if (l.state != LoopState::accepted) return out;
  out["weight"] = l.weight;
  out["residual"] = {{"translation", l.residual.head<3>().norm()},
                     {"rotation", l.residual.tail<3>().norm()}};
  return out;
}

}  // namespace

bool has_transform(const Loop& loop) {
  return !loop.registered_by.empty() && loop.decided_by != loop.registered_by;
}

Json metric_json(const Metric& m) {
  return {{"name", m.name}, {"unit", m.unit}, {"value", m.value}, {"better", to_string(m.better)}};
}

Metric read_metric(const Json& json) {
  Metric m{json.at("name"), 0, json.at("unit"), Better::neither};
  const Json& value = json.at("value");  // JSON knows no NaN: it was written as null
  m.value = value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
  for (const Better b : {Better::lower, Better::higher})
    if (json.at("better") == to_string(b)) m.better = b;
  return m;
}

Json report_json(const Known& known, const std::vector<StepRecord>& steps,
                 const std::vector<std::string>& warnings) {
  Json metrics = Json::array(), step_list = Json::array();
  for (const auto& m : known.metrics) metrics.push_back(metric_json(m));
  for (const auto& s : steps) step_list.push_back(step_json(s));
  return {{"cambium", program_version()},
          {"missions", missions_json(known.atlas)},
          {"islands", islands_json(known.atlas)},
          {"steps", step_list},
          {"metrics", metrics},
          {"warnings", warnings}};
}

std::string ledger_jsonl(const Atlas& atlas) {
  std::string out;
  for (const auto& loop : atlas.loops)
    out += loop_json(atlas, loop).dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
  return out;
}

}  // namespace cambium
