// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/verbs.hpp"

#include <algorithm>

namespace cambium {

const std::vector<Verb>& verbs() {
  static const std::vector<Verb> all = {
      {"filter", Kind::payload_filter, true, {"payload", "as"}, "Changes what the nodes saw"},
      {"recognize",
       Kind::place_recognizer,
       true,
       {"pairs", "min_path", "max_distance", "payload"},
       "Proposes pairs of nodes that may have seen the same place"},
      {"register",
       Kind::registration,
       true,
       {"payload", "loops"},
       "Computes the transform of every candidate, or of every accepted loop anew"},
      {"verify", Kind::loop_verifier, false, {}, "Accepts or rejects registered loops"},
      {"optimize",
       Kind::solver,
       false,
       {"attitude_sigma", "marginals"},
       "Brings the missions together and relaxes all constraints"},
      {"georeference", Kind::gnss_aligner, false, {}, "Ties each island to the globe"},
      {"export",
       Kind::map_exporter,
       false,
       {"payload", "label"},
       "Writes the map into the run folder"},
      {"evaluate",
       Kind::evaluator,
       false,
       {"payload", "reference", "label"},
       "Measures the map against the truth"},
  };
  return all;
}

const Verb* find_verb(const std::string& word) {
  const auto& all = verbs();
  const auto it =
      std::find_if(all.begin(), all.end(), [&](const Verb& v) { return v.word == word; });
  return it == all.end() ? nullptr : &*it;
}

std::vector<std::string> verb_words() {
  std::vector<std::string> words;
  for (const auto& v : verbs()) words.push_back(v.word);
  return words;
}

void StepKeys::params(ParamVisitor& v) {
  const auto has = [&](const char* key) {
    return verb_ && std::find(verb_->keys.begin(), verb_->keys.end(), key) != verb_->keys.end();
  };
  if (has("pairs"))
    v("pairs", pairs, "Which pairs of missions are compared",
      one_of({"within_missions", "between_missions", "all"}));
  if (has("min_path"))
    v("min_path", min_path,
      "Within a mission, nodes closer than this along the path are neighbours, not loops",
      at_least(0, "m"));
  if (has("max_distance"))
    v("max_distance", max_distance,
      "Missions whose paths GNSS or the map put farther apart than this are not compared; 0 = all "
      "are",
      at_least(0, "m"));
  if (has("payload")) v("payload", payload, "The stream of payloads that the step reads");
  if (has("loops"))
    v("loops", loops,
      "Which loops: the candidates from their guess, or the accepted ones again from the map",
      one_of({"candidates", "accepted"}));
  if (has("as")) v("as", as, "The stream that the filter writes; others keep reading theirs");
  if (has("label"))
    v("label", label, "Folder of an export (default: the plugin), prefix of metric names");
  if (has("reference"))
    v("reference", reference,
      "Folder with MISSION.tum for each mission; without it each mission brings its own truth");
  if (has("attitude_sigma"))
    v("attitude_sigma", attitude_sigma,
      "Trust in the roll and pitch that the missions measured by gravity; 0 = not used",
      between(0, 90, "deg"));
  if (has("marginals"))
    v("marginals", marginals,
      "Nodes, as MISSION/ID, whose standard deviations the report shall state");
}

}  // namespace cambium
