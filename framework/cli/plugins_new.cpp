// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "host.hpp"
#include "pipeline/diagnostics.hpp"
#include "plugins/templates.hpp"

namespace cambium::cli {
namespace {

struct Options {
  std::string kind, name;
  std::filesystem::path folder;
  bool python = false;
};

constexpr Kind kinds[] = {Kind::mission_reader, Kind::payload_filter, Kind::place_recognizer,
                          Kind::registration,   Kind::loop_verifier,  Kind::solver,
                          Kind::gnss_aligner,   Kind::map_exporter,   Kind::evaluator};

Kind kind_of(const std::string& word) {
  std::vector<std::string> known;
  for (const Kind kind : kinds) {
    if (word == to_string(kind)) return kind;
    known.emplace_back(to_string(kind));
  }
  throw Error(ErrorCode::config, "KIND",
              fmt::format("there is no kind '{}'{}", word, suggestion(word, known)));
}

void run(const Options& o) {
  const auto folder = o.folder.empty() ? std::filesystem::path(o.name) : o.folder;
  const Language language = o.python ? Language::python : Language::cpp;
  for (const auto& file : write_new_plugin(kind_of(o.kind), language, o.name, folder))
    fmt::print("{}\n", file.string());
  fmt::print("{}/README.md has the commands that build, check and run it.\n", folder.string());
}

}  // namespace

void add_plugins_new(CLI::App& plugins) {
  auto o = std::make_shared<Options>();
  CLI::App* sub =
      plugins.add_subcommand("new", "Write a plugin that builds, passes its laws and runs");
  sub->add_option("KIND", o->kind, "place_recognizer, registration, ...")->required();
  sub->add_option("NAME", o->name, "As in a pipeline, such as ring_key")->required();
  sub->add_option("--folder", o->folder, "Where to write it (default: NAME)");
  sub->add_flag("--python", o->python, "As one Python file instead of C++ (docs/python-plugins.md)");
  sub->footer(
      "Example: cambium plugins new place_recognizer my_method\n"
      "         cambium plugins new place_recognizer my_method --python");
  sub->callback([o] { run(*o); });
}

}  // namespace cambium::cli
