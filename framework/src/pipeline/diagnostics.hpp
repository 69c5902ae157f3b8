// SPDX-License-Identifier: BSD-3-Clause
// Collects every mistake of a file, so that a user sees them all at once.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace cambium {

class Diagnostics {
 public:
  void add(std::string where, std::string message);
  bool empty() const { return entries_.empty(); }
  /// Throws Error(config) with one line per mistake, if there is any.
  void throw_if_any() const;

 private:
  struct Entry {
    std::string where, message;
  };
  std::vector<Entry> entries_;
};

/// "; did you mean 'rings'?", or "; expected one of a, b, c" when nothing is near.
std::string suggestion(std::string_view word, const std::vector<std::string>& known);

}  // namespace cambium
