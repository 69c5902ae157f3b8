// SPDX-License-Identifier: BSD-3-Clause
// One parameter changed from outside the step: `optimize.loss: huber`, `--set register[2].x=3`.
#pragma once
#include <optional>
#include <string>

#include "pipeline/pipeline.hpp"

namespace cambium {

/// A text "NAME=VALUE" of the command line; both have the option as their place, so that a message
/// names what the user typed.
struct Setting {
  Yaml name, value;
};
/// `form` is what was expected ("VERB.PARAM=VALUE"), for the message. Nothing when there is no '='.
std::optional<Setting> parse_setting(const std::string& text, const std::string& form,
                                     Diagnostics& diagnostics);

/// `key` is VERB.PARAM (every step of that verb) or VERB[n].PARAM (the n-th, from 1).
void apply_override(Pipeline& pipeline, const Yaml& key, const Yaml& value,
                    Diagnostics& diagnostics);

/// The same from one text "VERB.PARAM=VALUE" of the command line.
void apply_override(Pipeline& pipeline, const std::string& text, Diagnostics& diagnostics);

}  // namespace cambium
