// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "engine/keys.hpp"
#include "engine/steps.hpp"

namespace cambium {
namespace {

namespace fs = std::filesystem;

// Files (relative to the export's folder) with the digests of their content.
using Written = std::vector<std::pair<std::string, Digest>>;

bool still_there(const Written& written, const fs::path& folder) {
  for (const auto& [name, digest] : written) {
    const fs::path file = folder / name;
    if (!fs::is_regular_file(file) || digest_file(file) != digest) return false;
  }
  return !written.empty();
}

Written write(const Configured& c, const Atlas& atlas, const fs::path& folder,
              const Context& context) {
  fs::create_directories(folder);
  Written out;
  for (const auto& file : c.as<MapExporter>().write(atlas, folder, context))
    out.emplace_back(fs::relative(file, folder).string(), digest_file(file));
  return out;
}

}  // namespace

// Files live in the run folder, so the cache remembers only their names and digests: when they are
// all still there, nothing is written again.
Known run_export(Known known, const StepScope& scope) {
  const Configured& c = scope.step.configured;
  const std::string& label = scope.step.keys.label;
  const fs::path folder = scope.out / (label.empty() ? scope.step.plugin : label);
  const Digest input = Hasher()
                           .add(atlas_key(known.atlas))
                           .add(stages_key(known.atlas))
                           .add("export")
                           .digest();
  Written written;
  scope.run_items(1, [&](std::size_t) {
    Making making;
    const auto compute = [&](const Context& context) {
      return write(c, known.atlas, folder, context);
    };
    written = scope.cached<Written>(c, input, making, compute);
    if (making.hit && !still_there(written, folder)) {
      written = compute(*scope.engine.context(scope.item_key(c, input), scope.seed));
      making.hit = false;
    }
    return making;
  });
  for (const auto& [name, digest] : written) scope.record.files.push_back(folder / name);
  scope.record.summary = fmt::format("{} file(s) in {}", written.size(), folder.string());
  return known;
}

}  // namespace cambium
