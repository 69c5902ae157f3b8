// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <cctype>
#include <regex>

#include "cambium/error.hpp"
#include "cambium/files.hpp"
#include "plugins/templates.hpp"

namespace cambium {
namespace {

namespace fs = std::filesystem;

void check_name(const std::string& name) {
  bool good = !name.empty() && std::islower(static_cast<unsigned char>(name[0])) != 0;
  for (const char c : name)
    good = good && (std::islower(static_cast<unsigned char>(c)) != 0 ||
                    std::isdigit(static_cast<unsigned char>(c)) != 0 || c == '_');
  if (!good)
    throw Error(
        ErrorCode::config, "NAME",
        fmt::format("expected small letters, digits and '_' such as 'ring_key', found '{}'", name));
}

// ring_key -> RingKey
std::string class_name(const std::string& name) {
  std::string out;
  bool upper = true;
  for (const char c : name) {
    if (c != '_') out += upper ? char(std::toupper(static_cast<unsigned char>(c))) : c;
    upper = c == '_';
  }
  return out;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

using Files = std::vector<std::pair<std::string, std::string>>;  // template, name

Files files_of(const std::string& kind, Language language, const std::string& name) {
  Files files = {{kind + ".yaml", name + ".yaml"}, {"forest.yaml.in", "forest.yaml"}};
  if (language == Language::cpp)
    files.insert(files.end(), {{kind + ".cpp", name + ".cpp"},
                               {"CMakeLists.txt.in", "CMakeLists.txt"},
                               {"README.md", "README.md"}});
  else
    files.insert(files.end(), {{kind + ".py", name + ".py"}, {"README.python.md", "README.md"}});
  if (!plugin_templates().contains(files[2].first))
    throw Error(ErrorCode::config, "KIND",
                fmt::format("a {} cannot be written in Python; leave out --python", kind));
  return files;
}

// In a pipeline a script stands under the name of what runs it.
std::string run_by_python(const std::string& yaml, const std::string& name) {
  static const std::regex step("(  - [a-z]+: )my_method"), reader("reader: my_method");
  const std::string params = "params: {script: " + name + ".py}";
  return std::regex_replace(std::regex_replace(yaml, step, "$1python\n    " + params), reader,
                            "reader: python, " + params);
}

std::string spaced(std::string kind) { return replaced(std::move(kind), "_", " "); }

}  // namespace

std::vector<fs::path> write_new_plugin(Kind kind, Language language, const std::string& name,
                                       const fs::path& folder) {
  check_name(name);
  const std::string word = to_string(kind);
  const Files files = files_of(word, language, name);
  if (fs::exists(folder) && (!fs::is_directory(folder) || !fs::is_empty(folder)))
    throw Error(ErrorCode::config, folder.string(),
                "is there already; name a new or empty folder with --folder");
  fs::create_directories(folder);
  std::vector<fs::path> written;
  for (const auto& [from, to] : files) {
    std::string text = plugin_templates().at(from);
    if (language == Language::python) text = run_by_python(text, name);
    text = replaced(replaced(std::move(text), "my_method", name), "my_word", word);
    text =
        replaced(replaced(std::move(text), "MyMethod", class_name(name)), "my_kind", spaced(word));
    write_file(folder / to, text);
    written.push_back(folder / to);
  }
  return written;
}

}  // namespace cambium
