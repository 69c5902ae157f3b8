// SPDX-License-Identifier: BSD-3-Clause
// What the engine gives a component while it works.
#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string_view>

namespace cambium {

enum class LogLevel { debug, info, warning, error };

/// Safe to use from several threads.
class Context {
 public:
  virtual ~Context() = default;
  virtual void log(LogLevel level, std::string_view message) const = 0;
  virtual bool cancelled() const = 0;
  void check_cancelled() const;  ///< throws Cancelled; call it at least once a second
  virtual int threads() const = 0;
  virtual std::uint64_t seed() const = 0;  ///< derived from (pipeline seed, step, item)
  virtual std::filesystem::path scratch() const = 0;  ///< a folder to write temporary files to
  /// Calls body(i) for i in 0..count-1, possibly side by side. Write results to slot i: then the
  /// outcome is the same for any thread count. The first exception (lowest i) is thrown again.
  virtual void parallel_for(std::size_t count,
                            const std::function<void(std::size_t)>& body) const = 0;

  /// For a component that runs alone (an exporter) and takes long: so many parts of its work come
  /// next; it may say so again for another row of parts.
  virtual void expect(std::size_t) const {}
  /// One part is done: the user sees it, and payloads that are kept for later make room when the
  /// process is above its memory budget. Call it while holding as little as possible.
  virtual void advance() const {}

  void debug(std::string_view m) const { log(LogLevel::debug, m); }
  void info(std::string_view m) const { log(LogLevel::info, m); }
  void warn(std::string_view m) const { log(LogLevel::warning, m); }
};

}  // namespace cambium
