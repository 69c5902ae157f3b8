// SPDX-License-Identifier: BSD-3-Clause
// A finished run, read back from its folder.
#pragma once
#include <filesystem>

#include "cambium/atlas.hpp"

namespace cambium {

/// `missions` as the run left them: islands of report.json, poses and georeferences of fused.g2o
/// and its siblings, loops of ledger.jsonl. The information of a loop is not in the ledger and
/// stays identity. Throws Error(data) when a file is absent or speaks of other missions.
Atlas read_run(const std::filesystem::path& run, Atlas missions);

}  // namespace cambium
