// SPDX-License-Identifier: BSD-3-Clause
// What a run folder says about the run: report.json and ledger.jsonl.
#pragma once
#include <nlohmann/json.hpp>

#include "engine/steps.hpp"

namespace cambium {

using Json = nlohmann::ordered_json;

Json metric_json(const Metric& metric);
Metric read_metric(const Json& json);  ///< throws nlohmann::json::exception

/// `missions`, `islands`, `steps`, `metrics`; see docs/formats.md.
Json report_json(const Known& known, const std::vector<StepRecord>& steps,
                 const std::vector<std::string>& warnings);

/// Whether T_tail_head is that of a registration that converged.
bool has_transform(const Loop& loop);

/// One line per candidate that was ever proposed: who proposed it, scores, verdict and reason,
/// final residual.
std::string ledger_jsonl(const Atlas& atlas);

}  // namespace cambium
