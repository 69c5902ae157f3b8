// SPDX-License-Identifier: BSD-3-Clause
#include "engine/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

namespace cambium {
namespace {

const char* name(LogLevel level) {
  switch (level) {
    case LogLevel::debug:
      return "debug";
    case LogLevel::info:
      return "info";
    case LogLevel::warning:
      return "warning";
    case LogLevel::error:
      return "error";
  }
  return "?";
}

std::string duration(double seconds) {
  if (seconds < 60) return fmt::format("{:.0f} s", seconds);
  return fmt::format("{:.0f} min {:02.0f} s", std::floor(seconds / 60), std::fmod(seconds, 60));
}

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

// Unlike fmt::print this does not throw when stderr goes to a full disk: the run goes on.
void print(const std::string& text) { std::fputs(text.c_str(), stderr); }

}  // namespace

Progress::Progress(Style style, LogLevel level)
    : style_(style), level_(level), terminal_(style == Style::automatic && isatty(2) != 0) {}

void Progress::log(LogLevel level, std::string_view message) {
  const std::lock_guard lock(mutex_);
  if (level == LogLevel::warning) warnings_.emplace_back(message);
  if (level < level_ || (style_ == Style::quiet && level < LogLevel::warning)) return;
  if (style_ == Style::json) {
    print(nlohmann::json{{"level", name(level)}, {"message", message}}.dump(
              -1, ' ', false, nlohmann::json::error_handler_t::replace) +
          "\n");
    return;
  }
  clear_bar();
  print(level == LogLevel::info ? fmt::format("{}\n", message)
                                : fmt::format("{}: {}\n", name(level), message));
}

void Progress::begin(const std::string& step) {
  const std::lock_guard lock(mutex_);
  step_ = step;
  total_ = done_ = 0;
  begin_ = row_ = drawn_ = std::chrono::steady_clock::now();
}

void Progress::expect(std::size_t items) {
  const std::lock_guard lock(mutex_);
  total_ = items;
  done_ = 0;
  row_ = std::chrono::steady_clock::now();
}

void Progress::advance() {
  const std::lock_guard lock(mutex_);
  // An item may have had a row of parts of its own, all of them done.
  done_ = std::min(done_ + 1, total_);
  draw();
}

void Progress::end(const std::string& summary) {
  const std::lock_guard lock(mutex_);
  clear_bar();
  if (style_ == Style::json)
    print(nlohmann::json{{"step", step_}, {"seconds", seconds_since(begin_)}, {"summary", summary}}
              .dump() +
          "\n");
  else if (style_ != Style::quiet)
    print(fmt::format("{:<36} {:>6.2f} s  {}\n", step_, seconds_since(begin_), summary));
}

std::string Progress::step() const {
  const std::lock_guard lock(mutex_);
  return step_;
}

std::vector<std::string> Progress::warnings() const {
  const std::lock_guard lock(mutex_);
  return warnings_;
}

void Progress::draw() {
  if (step_.empty()) return;  // a command that is no pipeline has no steps to tell of
  const auto now = std::chrono::steady_clock::now();
  const double pause = terminal_ ? 0.1 : 10.0;  // plain logs get a line every ten seconds
  if (std::chrono::duration<double>(now - drawn_).count() < pause) return;
  drawn_ = now;
  const double seconds = seconds_since(row_), rate = double(done_) / std::max(seconds, 1e-9);
  const double eta = double(total_ - done_) / std::max(rate, 1e-9);
  if (style_ == Style::json) {
    print(nlohmann::json{{"step", step_}, {"done", done_}, {"total", total_}, {"eta", eta}}.dump() +
          "\n");
  } else if (terminal_) {
    const int width = 24, filled = int(double(width) * double(done_) /
                                       double(std::max<std::size_t>(total_, 1)));
    print(fmt::format("\r\x1b[K{:<36} [{:=<{}}{: <{}}] {}/{}  {:.1f}/s  {} left", step_, "", filled,
                      "", width - filled, done_, total_, rate, duration(eta)));
    bar_shown_ = true;
  } else if (style_ != Style::quiet) {
    print(fmt::format("{}: {} of {}, {:.1f}/s, {} left\n", step_, done_, total_, rate,
                      duration(eta)));
  }
}

void Progress::clear_bar() {
  if (bar_shown_) print("\r\x1b[K");
  bar_shown_ = false;
}

}  // namespace cambium
