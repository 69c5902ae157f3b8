// SPDX-License-Identifier: BSD-3-Clause
// The verbs of a pipeline and the keys that the engine itself understands beside them.
#pragma once
#include <string>
#include <vector>

#include "cambium/kinds.hpp"

namespace cambium {

/// What a step does; the word that opens it in the YAML.
struct Verb {
  std::string word;
  Kind kind;
  bool per_platform;              ///< `platforms:` may override its parameters
  std::vector<std::string> keys;  ///< of StepKeys, besides the verb and `params`
  std::string doc;
};
const std::vector<Verb>& verbs();
const Verb* find_verb(const std::string& word);  ///< null when unknown
std::vector<std::string> verb_words();

/// Declared like the parameters of a plugin, so that binding, schema and docs are the same code.
struct StepKeys : Component {
  std::string pairs = "all";
  double min_path = 20;
  double max_distance = 100;
  std::string payload = "main";
  std::string loops = "candidates";
  std::string as = "main";
  std::string label;
  std::string reference;
  double attitude_sigma = 0;
  std::vector<std::string> marginals;

  /// Only the keys that `verb` has are visited.
  explicit StepKeys(const Verb* verb = nullptr) : verb_(verb) {}
  void params(ParamVisitor& v) override;

 private:
  const Verb* verb_;
};

}  // namespace cambium
