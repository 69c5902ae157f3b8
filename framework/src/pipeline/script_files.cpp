// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/script_files.hpp"

#include <cctype>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "cambium/files.hpp"

namespace cambium {
namespace {

namespace fs = std::filesystem;

std::set<std::string> words_of(const std::string& text) {
  std::set<std::string> out;
  std::string word;
  for (const char c : text + ' ') {
    const auto byte = static_cast<unsigned char>(c);
    if (std::isalnum(byte) || c == '_' || byte >= 0x80)  // letters of any language in UTF-8
      word += c;
    else if (!word.empty())
      out.insert(std::exchange(word, {}));
  }
  return out;
}

std::map<std::string, fs::path> beside(const fs::path& script) {
  std::map<std::string, fs::path> out;
  std::error_code error;
  for (fs::directory_iterator it(fs::absolute(script).parent_path(), error), end; it != end;
       it.increment(error))
    if (it->path().extension() == script.extension() && it->is_regular_file(error) &&
        it->path().filename() != script.filename())
      out.emplace(it->path().stem().string(), it->path());
  return out;
}

}  // namespace

std::vector<fs::path> script_files(const fs::path& script) {
  auto left = beside(script);
  std::map<std::string, fs::path> used;
  std::vector<fs::path> to_read{script};
  while (!to_read.empty()) {
    const std::string text = read_file(to_read.back());
    to_read.pop_back();
    for (const std::string& word : words_of(text))
      if (const auto found = left.extract(word)) {
        to_read.push_back(found.mapped());
        used.emplace(found.key(), found.mapped());
      }
  }
  std::vector<fs::path> out{script};
  for (const auto& [name, file] : used) out.push_back(file);
  return out;
}

Digest digest_script(const fs::path& script) {
  const auto files = script_files(script);
  if (files.size() == 1) return digest_file(script);
  Hasher hasher;
  for (const fs::path& file : files)
    hasher.add(file == script ? std::string() : file.filename().string()).add(digest_file(file));
  return hasher.digest();
}

}  // namespace cambium
