// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <cctype>

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

std::string spaced(std::string kind) { return replaced(std::move(kind), "_", " "); }

}  // namespace

std::vector<fs::path> write_new_plugin(Kind kind, const std::string& name, const fs::path& folder) {
  check_name(name);
  if (fs::exists(folder) && (!fs::is_directory(folder) || !fs::is_empty(folder)))
    throw Error(ErrorCode::config, folder.string(),
                "is there already; name a new or empty folder with --folder");
  fs::create_directories(folder);
  const std::string word = to_string(kind);
  const std::pair<std::string, std::string> files[] = {{word + ".cpp", name + ".cpp"},
                                                       {word + ".yaml", name + ".yaml"},
                                                       {"CMakeLists.txt.in", "CMakeLists.txt"},
                                                       {"README.md", "README.md"},
                                                       {"forest.yaml.in", "forest.yaml"}};
  std::vector<fs::path> written;
  for (const auto& [from, to] : files) {
    std::string text = replaced(plugin_templates().at(from), "my_method", name);
    text =
        replaced(replaced(std::move(text), "MyMethod", class_name(name)), "my_kind", spaced(word));
    write_file(folder / to, text);
    written.push_back(folder / to);
  }
  return written;
}

}  // namespace cambium
