// SPDX-License-Identifier: BSD-3-Clause
#include "matrix/datasets.hpp"

#include <fmt/format.h>
#include <glob.h>

#include <functional>

#include "cambium/files.hpp"
#include "engine/program.hpp"
#include "engine/child.hpp"
#include "simulate/simulate.hpp"
#include "simulate/spec_file.hpp"

namespace cambium::matrix {
namespace {

namespace fs = std::filesystem;

bool is_there(const std::string& path) {
  glob_t found{};
  const bool there = fs::exists(path) || ::glob(path.c_str(), 0, nullptr, &found) == 0;
  ::globfree(&found);
  return there;
}

bool check_there(const Dataset& dataset, const std::string& path) {
  if (is_there(path)) return true;
  if (dataset.optional) return false;
  throw Error(ErrorCode::config, path,
              fmt::format("is not there; the dataset '{}' may be left out with 'optional: true'",
                          dataset.name));
}

// Fills the folder by `make`, unless a stamp says that it holds what comes from `input` already.
// The stamp is written last, so it vouches for everything before it.
void fill_once(const fs::path& folder, const Digest& input, const std::function<void()>& make) {
  const fs::path stamp = folder.string() + ".stamp";
  const std::string made_from = input.hex() + "\n";
  if (fs::exists(stamp) && read_file(stamp) == made_from) return;
  fs::remove(stamp);
  fs::remove_all(folder);
  fs::create_directories(folder);
  make();
  write_file(stamp, made_from);
}

std::vector<std::string> simulate_into(const fs::path& folder, const fs::path& spec_file,
                                       const Context& context) {
  const std::string text = read_file(spec_file);
  const auto spec = simulate::parse_spec(text, spec_file.string());
  fill_once(folder, Hasher().add(text).add(program_build()).digest(), [&] {
    context.info(fmt::format("simulating {}", spec_file.string()));
    simulate::simulate(spec, text, folder, context);
  });
  std::vector<std::string> missions;
  for (const auto& m : spec.missions) missions.push_back((folder / m.name).string());
  return missions;
}

void unpack_into(const fs::path& folder, const fs::path& archive, const Context& context) {
  fill_once(folder, digest_file(archive), [&] {
    context.info(fmt::format("unpacking {}", archive.string()));
    const fs::path log = folder.string() + ".log";
    Child tar({"/usr/bin/env", "tar", "-xf", archive.string(), "-C", folder.string()}, log, 3600);
    while (!tar.ended()) {
      wait_any({tar.descriptor()}, 0.2);
      context.check_cancelled();
    }
    if (tar.outcome().exit_code != 0 || tar.outcome().signal != 0)
      throw Error(ErrorCode::data, archive.string(),
                  "cannot be unpacked by tar; see " + log.string());
  });
}

}  // namespace

std::vector<std::string> prepare(const Dataset& dataset, const fs::path& folder,
                                 const Context& context) {
  if (!dataset.simulate.empty()) return simulate_into(folder, dataset.simulate, context);
  std::vector<std::string> paths = dataset.missions;
  if (!dataset.archive.empty()) {
    if (!check_there(dataset, dataset.archive)) return {};
    unpack_into(folder, dataset.archive, context);
    for (std::string& path : paths) path = (folder / path).string();
  }
  for (const std::string& path : paths)
    if (!check_there(dataset, path)) return {};
  return paths;
}

}  // namespace cambium::matrix
