// SPDX-License-Identifier: BSD-3-Clause
#include "conformance/judge.hpp"

#include <fmt/format.h>

#include <fstream>
#include <sstream>

#include "cambium/files.hpp"
#include "conformance/law.hpp"
#include "plugins/elf.hpp"

namespace cambium::conformance {
namespace {

Finding judge(const std::string& name, const std::string& law, const std::function<void()>& check) {
  try {
    check();
    return {name, law, Outcome::holds, {}};
  } catch (const NotApplicable& e) {
    return {name, law, Outcome::not_applicable, e.what()};
  } catch (const std::exception& e) {
    return {name, law, Outcome::broken, e.what()};
  }
}

void exports_one_symbol(const std::filesystem::path& library) {
  std::string others;
  const auto symbols = exported_symbols(read_file(library), library.string());
  for (const std::string& symbol : symbols)
    if (symbol != "cambium_plugin" && others.size() < 300) others += " " + symbol;
  require(others.empty(),
          fmt::format("exports {} symbols besides 'cambium_plugin', which may collide "
                      "with those of other plugins:{}; build with "
                      "cambium_add_plugin()",
                      symbols.size() - 1, others));
}

constexpr const char* marks[] = {"holds", "broken", "not_applicable"};

std::string one_line(std::string text) {
  for (char& c : text)
    if (c == '\n' || c == '\t') c = ' ';
  return text;
}

}  // namespace

std::vector<Finding> judge_library(const std::filesystem::path& library) {
  const std::string name = library.filename().string();
  return {judge(name, "opens in this host", [&] { PluginLoader().load_file(library); }),
          judge(name, "exports one symbol", [&] { exports_one_symbol(library); })};
}

void judge_here(const Registered& registered, const Registry& registry,
                const std::filesystem::path& record) {
  std::ofstream out(record);
  const World world = make_world();
  const Subject subject{registered, registry, registered.create(), world};
  const Exercise use = exercise(subject);
  std::vector<Law> laws = parameter_laws();
  for (const Law& law : call_laws(use)) laws.push_back(law);
  for (const Law& law : use.own) laws.push_back(law);
  for (const Law& law : laws) {
    out << "begin\t" << law.name << '\n' << std::flush;
    const Finding f = judge(registered.name, law.name, [&] { law.check(subject); });
    out << marks[int(f.outcome)] << '\t' << law.name << '\t' << one_line(f.detail) << '\n'
        << std::flush;
  }
}

std::vector<Finding> read_record(const std::string& component, const std::string& record,
                                 const std::string& ending, const std::string& printed) {
  std::vector<Finding> out;
  std::istringstream lines(record);
  std::string mark, law, detail, begun;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream fields(line);
    detail.clear();
    std::getline(fields, mark, '\t');
    std::getline(fields, law, '\t');
    std::getline(fields, detail);
    begun = mark == "begin" ? law : "";
    for (int i = 0; i < 3; ++i)
      if (mark == marks[i]) out.push_back({component, law, Outcome(i), detail});
  }
  if (!ending.empty())
    out.push_back(
        {component, begun.empty() ? "can be tried at all" : begun, Outcome::broken,
         fmt::format("the process {}; the laws after this one were not checked", ending)});
  const bool silent = printed.empty();
  out.push_back({component, "prints nothing", silent ? Outcome::holds : Outcome::broken,
                 silent ? ""
                        : fmt::format("printed '{}'; use context.info() or context.warn()",
                                      one_line(printed.substr(0, 200)))});
  return out;
}

}  // namespace cambium::conformance
