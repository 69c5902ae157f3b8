// SPDX-License-Identifier: BSD-3-Clause
// What a user sees while a pipeline runs: a bar with rate and ETA on a terminal, plain lines
// elsewhere, or JSON lines. Everything goes to stderr; stdout is for results.
#pragma once
#include <chrono>
#include <mutex>
#include <string>
#include <vector>

#include "cambium/context.hpp"

namespace cambium {

class Progress {
 public:
  enum class Style { automatic, lines, json, quiet };
  explicit Progress(Style style, LogLevel level = LogLevel::info);

  void log(LogLevel level, std::string_view message);
  void begin(const std::string& step);  ///< the clock of the step starts
  void expect(std::size_t items);       ///< a row of work items begins; a step may have several
  void advance();                       ///< one item more, up to those expected; thread-safe
  void end(const std::string& summary);
  std::string step() const;             ///< that began last
  std::vector<std::string> warnings() const;  ///< all so far, for the report

 private:
  void draw();
  void clear_bar();

  Style style_;
  LogLevel level_;
  bool terminal_ = false;
  mutable std::mutex mutex_;
  std::vector<std::string> warnings_;
  std::string step_;
  std::size_t total_ = 0, done_ = 0;
  std::chrono::steady_clock::time_point begin_, row_, drawn_;
  bool bar_shown_ = false;
};

}  // namespace cambium
