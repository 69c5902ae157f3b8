// SPDX-License-Identifier: BSD-3-Clause
// One line of an NMEA 0183 log.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cambium {

struct NmeaSentence {
  std::string type;                 ///< "GGA", whichever system the talker is
  std::vector<std::string> fields;  ///< behind the address; those that are not there are empty

  const std::string& field(std::size_t i) const;
  std::optional<double> number(std::size_t i) const;  ///< nothing when empty or no number
};

enum class SentenceState { whole, damaged, none };

/// From the `$` on; what a logger writes in front of it is not looked at. `damaged`: without a
/// checksum, or with one that does not fit. `none`: not a standard sentence.
SentenceState parse_sentence(std::string_view line, NmeaSentence& out);

/// Time of day [ns] of hhmmss[.sss].
std::optional<std::int64_t> nmea_time(const std::string& text);
/// Degrees of [d]ddmm.mmmm and its hemisphere, N S E W.
std::optional<double> nmea_degrees(const std::string& text, const std::string& hemisphere);
/// Days since 1970-01-01.
std::optional<std::int64_t> days_since_1970(int year, int month, int day);

}  // namespace cambium
