// SPDX-License-Identifier: BSD-3-Clause
// A fault that every line of a file has makes one warning, not a million.
#pragma once
#include <algorithm>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace cambium {

class Warnings {
 public:
  void add(int line, std::string_view message) {
    auto it = counts_.find(message);
    if (it == counts_.end()) it = counts_.emplace(message, Count{line, 0}).first;
    it->second.first_line = std::min(it->second.first_line, line);
    ++it->second.lines;
  }

  /// `file:line: message`, in the order of the lines.
  std::vector<std::string> list(const std::filesystem::path& file) const {
    std::vector<std::pair<int, std::string>> rows;
    for (const auto& [message, count] : counts_) {
      std::string text = file.string() + ":" + std::to_string(count.first_line) + ": " + message;
      if (count.lines > 1) text += " (" + std::to_string(count.lines) + " such lines)";
      rows.emplace_back(count.first_line, std::move(text));
    }
    std::sort(rows.begin(), rows.end());
    std::vector<std::string> out;
    for (auto& row : rows) out.push_back(std::move(row.second));
    return out;
  }

 private:
  struct Count {
    int first_line = 0, lines = 0;
  };
  std::map<std::string, Count, std::less<>> counts_;
};

}  // namespace cambium
