// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "host.hpp"
#include "pipeline/schema.hpp"

namespace cambium::cli {

void add_schema(CLI::App& app) {
  auto options = std::make_shared<PluginOptions>();
  CLI::App* sub = app.add_subcommand("schema", "JSON Schema of pipelines with the plugins found");
  options->add_to(*sub);
  sub->footer("Example: cambium schema > schemas/pipeline.schema.json");
  sub->callback([options] {
    const PluginLoader loader = options->load();
    fmt::print("{}\n", pipeline_schema(loader.registry()).dump(2));
  });
}

}  // namespace cambium::cli
