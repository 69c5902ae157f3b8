// SPDX-License-Identifier: BSD-3-Clause
// Texts that come again and again, written once: what pages keep beside rows of numbers.
#pragma once
#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace cambium {

/// Texts with a number each, in order of their first use.
class StringTable {
 public:
  /// The number of `text`; the next one where it is new.
  std::size_t operator()(const std::string& text) {
    const auto [it, is_new] = numbers_.emplace(text, list_.size());
    if (is_new) list_.push_back(text);
    return it->second;
  }
  const std::vector<std::string>& list() const { return list_; }  ///< by number

 private:
  std::map<std::string, std::size_t> numbers_;
  std::vector<std::string> list_;
};

}  // namespace cambium
