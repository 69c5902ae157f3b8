// SPDX-License-Identifier: BSD-3-Clause
// An export of a run that has ended.
#pragma once
#include "engine/engine.hpp"
#include "plugins/loader.hpp"

namespace cambium {

/// The exporter that makes a page for browsers: `name`, or the only one when it is empty. Throws
/// Error(config) when there is none, `name` makes none, or several could be meant.
std::string page_exporter(const std::string& name, const Registry& registry);

/// Runs an exporter over a finished run as a step at its end would have run: behind the same
/// filters, into RUN/<exporter>. Throws Error(config) when the folder holds no run.
void export_run(const std::filesystem::path& run, const std::string& exporter,
                const Registry& registry, const Engine& engine);

}  // namespace cambium
