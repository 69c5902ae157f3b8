// SPDX-License-Identifier: BSD-3-Clause
#include "nmea_file.hpp"

#include <cstdlib>
#include <map>
#include <optional>

#include "cambium/error.hpp"
#include "cambium/files.hpp"
#include "fix_quality.hpp"
#include "nmea_sentence.hpp"

namespace cambium {
namespace {

constexpr std::int64_t second = 1'000'000'000, day_length = 86400 * second;
constexpr double geoid_range = 60;  ///< [m] sigma of a height whose geoid separation is missing

struct Line {
  int number;
  NmeaSentence sentence;
};

/// How often something was wrong, and where first.
class Complaint {
 public:
  void add(int line) {
    if (count_++ == 0) first_ = line;
  }
  void report(const std::filesystem::path& path, const std::string& what,
              std::vector<std::string>& warnings) const {
    if (count_ > 0)
      warnings.push_back(path.string() + ":" + std::to_string(first_) + ": " +
                         std::to_string(count_) + " " + what);
  }

 private:
  int count_ = 0, first_ = 0;
};

std::optional<std::int64_t> date_of(const NmeaSentence& s) {
  const auto part = [](const std::string& text, std::size_t at, std::size_t size) {
    return at + size <= text.size() ? std::atoi(text.substr(at, size).c_str()) : 0;
  };
  if (s.type == "ZDA")
    return days_since_1970(part(s.field(3), 0, 4), part(s.field(2), 0, 2), part(s.field(1), 0, 2));
  if (s.type != "RMC" || s.field(8).size() != 6) return std::nullopt;
  const int year = part(s.field(8), 4, 2);
  return days_since_1970(year + (year < 80 ? 2000 : 1900), part(s.field(8), 2, 2),
                         part(s.field(8), 0, 2));
}

/// Time of day to time: the date may come late, and midnight may pass in between.
class Clock {
 public:
  Clock(const std::vector<Line>& lines, const std::filesystem::path& path) {
    for (const Line& line : lines) {
      const auto date = date_of(line.sentence);
      const auto time = nmea_time(line.sentence.field(0));
      if (!date || !time) continue;
      day_ = *date;
      last_ = *time;
      return;
    }
    throw Error(ErrorCode::data, path.string(),
                "no RMC and no ZDA sentence gives a date; have the receiver write RMC, or make a "
                "gnss.csv");
  }
  /// In the order of the file.
  Stamp at(const NmeaSentence& s, std::int64_t time) {
    if (time < last_ - day_length / 2) ++day_;
    if (time > last_ + day_length / 2) --day_;
    if (const auto date = date_of(s)) day_ = *date;
    last_ = time;
    return {day_ * 86400 + time / second, std::int32_t(time % second)};
  }

 private:
  std::int64_t day_ = 0, last_ = 0;
};

std::vector<Line> read_lines(const std::filesystem::path& path,
                             std::vector<std::string>& warnings) {
  const std::string content = read_file(path);
  std::vector<Line> lines;
  Complaint damaged;
  std::string_view text = content;
  for (int number = 1; !text.empty(); ++number) {
    const auto end = text.find('\n');
    NmeaSentence sentence;
    const SentenceState state = parse_sentence(text.substr(0, end), sentence);
    if (state == SentenceState::damaged) damaged.add(number);
    if (state == SentenceState::whole) lines.push_back({number, std::move(sentence)});
    text.remove_prefix(end == text.npos ? text.size() : end + 1);
  }
  damaged.report(path, "sentences whose checksum is missing or wrong are left out", warnings);
  return lines;
}

/// Nothing when the sentence tells no place.
std::optional<GnssFix> fix_of(const NmeaSentence& gga, bool& without_geoid) {
  const auto latitude = nmea_degrees(gga.field(1), gga.field(2));
  const auto longitude = nmea_degrees(gga.field(3), gga.field(4));
  const auto quality = gga.number(5), altitude = gga.number(8), separation = gga.number(10);
  if (!latitude || !longitude || !altitude || !quality || !measured(int(*quality)))
    return std::nullopt;
  GnssFix fix;
  fix.latitude = *latitude;
  fix.longitude = *longitude;
  fix.altitude = *altitude + separation.value_or(0);  // the former is above the geoid
  fix.covariance = covariance_of_quality(int(*quality), gga.number(7).value_or(1));
  without_geoid = !separation;
  if (without_geoid) fix.covariance(2, 2) += geoid_range * geoid_range;
  return fix;
}

void apply_gst(const NmeaSentence& gst, GnssFix& fix) {
  const auto north = gst.number(5), east = gst.number(6), up = gst.number(7);
  if (!north || !east || !up || *north <= 0 || *east <= 0 || *up <= 0) return;
  const bool without_geoid = fix.covariance(2, 2) > geoid_range * geoid_range;
  fix.covariance = Vec3(*east, *north, *up).cwiseAbs2().asDiagonal();
  if (without_geoid) fix.covariance(2, 2) += geoid_range * geoid_range;
}

}  // namespace

std::vector<GnssFix> load_nmea(const std::filesystem::path& path,
                               std::vector<std::string>& warnings) {
  const std::vector<Line> lines = read_lines(path, warnings);
  Clock clock(lines, path);
  std::map<Stamp, GnssFix> fixes;  // receivers that write GP and GN sentences tell a place twice
  std::map<Stamp, NmeaSentence> sigmas;
  Complaint no_place, no_geoid;
  for (const auto& [number, sentence] : lines) {
    const auto time = nmea_time(sentence.field(0));
    if (sentence.type == "GGA" && !time) no_place.add(number);
    const bool timed = sentence.type == "GGA" || sentence.type == "RMC" || sentence.type == "ZDA" ||
                       sentence.type == "GST";
    if (!timed || !time) continue;
    const Stamp stamp = clock.at(sentence, *time);
    if (sentence.type == "GST") sigmas.emplace(stamp, sentence);
    if (sentence.type != "GGA") continue;
    bool without_geoid = false;
    auto fix = fix_of(sentence, without_geoid);
    if (!fix) no_place.add(number);
    if (!fix) continue;
    if (without_geoid) no_geoid.add(number);
    fix->stamp = stamp;
    fixes.emplace(stamp, *fix);
  }
  no_place.report(path, "GGA sentences tell no place (no fix, or empty fields)", warnings);
  no_geoid.report(path,
                  "GGA sentences have no geoid separation; their heights above sea level are taken "
                  "as ellipsoidal, with a sigma of 60 m",
                  warnings);
  std::vector<GnssFix> out;
  for (auto& [stamp, fix] : fixes) {
    if (const auto gst = sigmas.find(stamp); gst != sigmas.end()) apply_gst(gst->second, fix);
    out.push_back(fix);
  }
  return out;
}

}  // namespace cambium
