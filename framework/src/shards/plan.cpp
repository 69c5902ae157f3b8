// SPDX-License-Identifier: BSD-3-Clause
#include "shards/plan.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cambium/files.hpp"
#include "engine/meeting.hpp"
#include "engine/missions.hpp"
#include "engine/program.hpp"

namespace cambium::shards {
namespace {

// Every node of the query gets its candidates registered, which is where the time goes; comparing
// its fingerprint with all those of the reference costs about a thousandth of a registration each.
double estimated_cost(const Mission& query, const Mission& reference) {
  return double(query.nodes.size()) * (1 + 1e-3 * double(reference.nodes.size()));
}

/// Up to how far apart any step compares missions; 0: it does not matter to one of them.
double widest(const ResolvedPipeline& pipeline) {
  double out = -1;
  for (const Step& step : pipeline.steps) {
    if (step.verb->kind != Kind::place_recognizer) continue;
    if (step.keys.max_distance == 0) return 0;
    out = std::max(out, step.keys.max_distance);
  }
  return std::max(out, 0.0);
}

}  // namespace

Plan make_plan(const ResolvedPipeline& pipeline, const Registry& registry, const Engine& engine) {
  Plan plan{to_yaml(pipeline), program_build().hex(), 0, {}};
  for (const std::size_t wave : waves_of(pipeline)) plan.waves = std::max(plan.waves, wave);
  const Atlas atlas = read_missions(pipeline.spec, registry, engine);
  const Meetings meetings(atlas, widest(pipeline));
  for (std::size_t q = 0; q < atlas.missions.size(); ++q)
    for (std::size_t r = 0; r <= q; ++r) {
      const Mission &query = *atlas.missions[q].mission, &reference = *atlas.missions[r].mission;
      const bool meet = meetings.apart(std::uint32_t(q), std::uint32_t(r)) == Meetings::Apart::no;
      plan.pairs.push_back(
          {query.name, reference.name, meet ? estimated_cost(query, reference) : 0.0});
    }
  return plan;
}

Json to_json(const Plan& plan) {
  Json pairs = Json::array();
  for (const Pair& p : plan.pairs)
    pairs.push_back({{"query", p.query}, {"reference", p.reference}, {"cost", p.cost}});
  return {{"cambium_plan", 1},
          {"program", plan.program},
          {"waves", plan.waves},
          {"pairs", pairs},
          {"pipeline", plan.pipeline}};
}

Plan read_plan(const std::filesystem::path& file) {
  Plan plan;
  try {
    const Json json = Json::parse(read_file(file));
    if (json.at("cambium_plan") != 1)
      throw Error(ErrorCode::config, file.string(), "is a plan of another version of Cambium");
    plan.program = json.at("program");
    plan.waves = json.at("waves");
    plan.pipeline = json.at("pipeline");
    for (const Json& p : json.at("pairs"))
      plan.pairs.push_back({p.at("query"), p.at("reference"), p.at("cost")});
  } catch (const nlohmann::json::exception& e) {
    throw Error(ErrorCode::config, file.string(),
                fmt::format("expected a plan written by 'cambium plan': {}", e.what()));
  }
  if (plan.program != program_build().hex())
    throw Error(ErrorCode::config, file.string(),
                "was planned by another build of Cambium; every machine must run the same program "
                "and libcambium, or results from the cache do not fit");
  return plan;
}

ResolvedPipeline pipeline_of(const Plan& plan, const std::filesystem::path& file,
                             const Registry& registry) {
  return resolve(parse_pipeline(plan.pipeline, file), registry);
}

}  // namespace cambium::shards
