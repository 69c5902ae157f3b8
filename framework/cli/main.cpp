// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "engine/program.hpp"
#include "host.hpp"
#include "plugins/handshake.hpp"

namespace {

int run(int argc, char** argv) {
  CLI::App app("Fuses lidar SLAM missions from many robots into one map.");
  const bool with_abi = std::find(argv, argv + argc, std::string_view("--abi")) != argv + argc;
  CLI::Option* version = app.set_version_flag("--version", [with_abi] {
    const std::string name = "cambium " + cambium::program_version();
    return with_abi ? name + "\n" + cambium::abi_text() : name;
  });
  bool abi = false;  // read from argv above: the version's text is asked for while they are parsed
  app.add_flag("--abi", abi, "With --version: what a plugin must have been built with")
      ->needs(version);
  app.require_subcommand(1);
  app.footer(
      "Example: cambium run pipelines/fuse_scans.yaml mission_a mission_b --out fused\n"
      "'cambium COMMAND --help' explains a command.");
  using namespace cambium::cli;
  add_run(app);
  add_validate(app);
  add_inspect(app);
  add_import(app);
  add_evaluate(app);
  add_plugins(app);
  add_schema(app);
  add_simulate(app);
  add_cache(app);
  add_matrix(app);
  add_batch(app);
  add_compare(app);
  add_plan(app);
  add_merge(app);
  add_split(app);
  add_poses(app);
  add_report(app);
  add_query(app);
  add_changes(app);
  add_view(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    const int code = app.exit(e);
    return code == 0 ? 0 : int(cambium::ErrorCode::config);
  }
  return 0;
}

}  // namespace

// A full disk behind `cambium ... > file` shows only when the buffer is written.
int flushed(int code) {
  if (std::fflush(stdout) == 0) return code;
  std::perror("error: the output cannot be written");
  return code == 0 ? int(cambium::ErrorCode::data) : code;
}

int main(int argc, char** argv) {
  try {
    return flushed(run(argc, argv));
  } catch (const cambium::Error& e) {
    fmt::print(stderr, "error: {}\n", e.what());
    return int(e.code());
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "error: out of memory; try a smaller --memory or fewer --threads\n");
    return int(cambium::ErrorCode::data);
  } catch (const std::filesystem::filesystem_error& e) {
    fmt::print(stderr, "error: {}\n", e.what());
    return int(cambium::ErrorCode::data);
  } catch (const std::exception& e) {
    fmt::print(stderr, "error: {}\n", e.what());
    return int(cambium::ErrorCode::plugin);
  }
}
