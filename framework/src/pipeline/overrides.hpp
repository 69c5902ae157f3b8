// SPDX-License-Identifier: BSD-3-Clause
// One parameter changed from outside the step: `optimize.loss: huber`, `--set register[2].x=3`.
#pragma once
#include <string>

#include "pipeline/pipeline.hpp"

namespace cambium {

/// `key` is VERB.PARAM (every step of that verb) or VERB[n].PARAM (the n-th, from 1).
void apply_override(Pipeline& pipeline, const Yaml& key, const Yaml& value,
                    Diagnostics& diagnostics);

/// The same from one text "VERB.PARAM=VALUE" of the command line.
void apply_override(Pipeline& pipeline, const std::string& text, Diagnostics& diagnostics);

}  // namespace cambium
