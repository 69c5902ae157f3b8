// SPDX-License-Identifier: BSD-3-Clause
#include "engine/wiring.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace cambium {
namespace {

// The loops on their way through the steps; each verb moves them on.
enum class Loops { none, candidates, registered, judged };

void check_order(const StepSpec& step, Loops& loops, Diagnostics& diagnostics) {
  const std::string& verb = step.verb->word;
  if (verb == "recognize") {
    loops = Loops::candidates;
  } else if (verb == "register" && step.keys.loops == "accepted") {
    if (loops != Loops::judged)
      diagnostics.add(step.where,
                      "'register' with 'loops: accepted' has no accepted loops to work on; put a "
                      "'verify' step right before it, or an 'optimize' step behind one");
  } else if (verb == "register") {
    if (loops != Loops::candidates)
      diagnostics.add(step.where,
                      "'register' has no candidates to work on; put a 'recognize' "
                      "step before it");
    loops = Loops::registered;
  } else if (verb == "verify") {
    if (loops != Loops::registered && loops != Loops::judged)
      diagnostics.add(step.where,
                      "'verify' has no registered loops to judge; put 'recognize' and "
                      "'register' steps before it");
    loops = Loops::judged;
  } else if (verb == "optimize") {
    if (loops == Loops::candidates || loops == Loops::registered)
      diagnostics.add(step.where,
                      "'optimize' uses accepted loops only, and no 'verify' step has "
                      "judged the loops found before it");
  }
}

void check_streams(const StepSpec& step, std::vector<std::string>& streams,
                   Diagnostics& diagnostics) {
  const auto& k = step.keys;
  if (std::find(streams.begin(), streams.end(), k.payload) == streams.end())
    diagnostics.add(step.where, fmt::format("no earlier filter writes the payload stream '{}'{}",
                                            k.payload, suggestion(k.payload, streams)));
  if (step.verb->kind == Kind::payload_filter) streams.push_back(k.as);
}

}  // namespace

void check_wiring(const Pipeline& pipeline, Diagnostics& diagnostics) {
  Loops loops = Loops::none;
  std::vector<std::string> streams = {"main"}, folders;
  for (const auto& step : pipeline.steps) {
    check_order(step, loops, diagnostics);
    check_streams(step, streams, diagnostics);
    if (step.verb->kind != Kind::map_exporter) continue;
    const std::string folder = step.keys.label.empty() ? step.plugin : step.keys.label;
    if (std::find(folders.begin(), folders.end(), folder) != folders.end())
      diagnostics.add(step.where, fmt::format("two exports would write to the folder '{}'; give "
                                              "one of them a 'label'",
                                              folder));
    folders.push_back(folder);
  }
}

}  // namespace cambium
