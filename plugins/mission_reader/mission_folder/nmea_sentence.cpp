// SPDX-License-Identifier: BSD-3-Clause
#include "nmea_sentence.hpp"

#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdint>

namespace cambium {
namespace {

template <class T>
std::optional<T> parsed(std::string_view text, int base = 10) {
  T value{};
  const char* end = text.data() + text.size();
  const auto result = [&] {
    if constexpr (std::is_integral_v<T>)
      return std::from_chars(text.data(), end, value, base);
    else
      return std::from_chars(text.data(), end, value);
  }();
  if (text.empty() || result.ec != std::errc{} || result.ptr != end) return std::nullopt;
  return value;
}

bool digits(std::string_view text) {
  return !text.empty() && text.find_first_not_of("0123456789") == text.npos;
}

}  // namespace

const std::string& NmeaSentence::field(std::size_t i) const {
  static const std::string nothing;
  return i < fields.size() ? fields[i] : nothing;
}

std::optional<double> NmeaSentence::number(std::size_t i) const {
  const auto value = parsed<double>(field(i));
  return value && std::isfinite(*value) ? value : std::nullopt;
}

SentenceState parse_sentence(std::string_view line, NmeaSentence& out) {
  const auto dollar = line.find('$');
  if (dollar == line.npos) return SentenceState::none;
  line.remove_prefix(dollar + 1);
  line = line.substr(0, line.find_last_not_of(" \t\r\n") + 1);
  if (line.size() < 5 || line[0] == 'P') return SentenceState::none;  // P: of one manufacturer
  const auto star = line.rfind('*');
  if (star == line.npos) return SentenceState::damaged;
  unsigned sum = 0;
  for (const char c : line.substr(0, star)) sum ^= static_cast<unsigned char>(c);
  if (parsed<unsigned>(line.substr(star + 1), 16) != sum) return SentenceState::damaged;
  line = line.substr(0, star);
  const auto comma = line.find(',');
  if (comma != 5) return SentenceState::none;
  out.type = line.substr(2, 3);
  out.fields.clear();
  for (std::string_view rest = line.substr(comma);;) {
    rest.remove_prefix(1);
    const auto next = rest.find(',');
    out.fields.emplace_back(rest.substr(0, next));
    if (next == rest.npos) return SentenceState::whole;
    rest.remove_prefix(next);
  }
}

std::optional<std::int64_t> nmea_time(const std::string& text) {
  const std::string_view whole = std::string_view(text).substr(0, 6);
  if (text.size() < 6 || !digits(whole)) return std::nullopt;
  std::int64_t fraction = 0;
  if (text.size() > 6) {
    std::string nano = text.substr(7, 9);
    if (text[6] != '.' || (!nano.empty() && !digits(nano))) return std::nullopt;
    nano.resize(9, '0');
    fraction = *parsed<std::int64_t>(nano);
  }
  const auto two = [&](std::size_t at) { return *parsed<std::int64_t>(whole.substr(at, 2)); };
  if (two(0) > 23 || two(2) > 59 || two(4) > 60) return std::nullopt;
  return ((two(0) * 60 + two(2)) * 60 + two(4)) * 1'000'000'000 + fraction;
}

std::optional<double> nmea_degrees(const std::string& text, const std::string& hemisphere) {
  const bool longitude = hemisphere == "E" || hemisphere == "W";
  const std::size_t of_degrees = longitude ? 3 : 2;
  if (!longitude && hemisphere != "N" && hemisphere != "S") return std::nullopt;
  if (text.size() < of_degrees + 2 || !digits(text.substr(0, of_degrees + 2))) return std::nullopt;
  const auto minutes = parsed<double>(std::string_view(text).substr(of_degrees));
  if (!minutes || *minutes >= 60) return std::nullopt;
  const double degrees = *parsed<int>(text.substr(0, of_degrees)) + *minutes / 60;
  if (degrees > (longitude ? 180 : 90)) return std::nullopt;
  return hemisphere == "S" || hemisphere == "W" ? -degrees : degrees;
}

std::optional<std::int64_t> days_since_1970(int year, int month, int day) {
  const std::chrono::year_month_day date{std::chrono::year(year),
                                         std::chrono::month(unsigned(month)),
                                         std::chrono::day(unsigned(day))};
  if (!date.ok()) return std::nullopt;
  return std::chrono::sys_days(date).time_since_epoch().count();
}

}  // namespace cambium
