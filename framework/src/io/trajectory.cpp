// SPDX-License-Identifier: BSD-3-Clause
// TUM trajectories: stamp x y z qx qy qz qw, blank separated, comments with '#'.
#include <fmt/format.h>

#include <charconv>
#include <optional>

#include "cambium/dialect.hpp"
#include "cambium/error.hpp"
#include "cambium/files.hpp"
#include "io/pose_fields.hpp"

namespace cambium {
namespace {

constexpr std::int64_t latest_second = 100'000'000'000;  // year 5138: more is not seconds

// Exact in decimal: a double has only 200 ns near today's seconds. Takes "12.5" and numpy's
// "1.25e+01"; digits beyond nanoseconds are cut.
std::optional<Stamp> parse_stamp(std::string_view text) {
  int exponent = 0;
  if (const auto e = text.find_first_of("eE"); e != text.npos) {
    std::string_view tail = text.substr(e + 1);
    if (tail.starts_with('+')) tail.remove_prefix(1);
    const auto [end, error] = std::from_chars(tail.data(), tail.data() + tail.size(), exponent);
    if (error != std::errc{} || end != tail.data() + tail.size()) return std::nullopt;
    text = text.substr(0, e);
  }
  const auto point = std::min(text.find('.'), text.size());
  std::string digits(text.substr(0, point));
  if (point < text.size()) digits += text.substr(point + 1);
  if (digits.empty() || digits.find_first_not_of("0123456789") != digits.npos) return std::nullopt;
  if (exponent < -30 || exponent > 30) return std::nullopt;
  const int whole = int(point) + exponent;  // digits before the decimal point
  if (whole < 0) digits.insert(0, std::size_t(-whole), '0');
  const auto split = std::size_t(std::max(whole, 0));
  digits.resize(std::max(digits.size(), split + 9), '0');
  Stamp stamp;
  if (split > 0) {
    const auto result = std::from_chars(digits.data(), digits.data() + split, stamp.sec);
    if (result.ec != std::errc{}) stamp.sec = latest_second;
  }
  std::from_chars(digits.data() + split, digits.data() + split + 9, stamp.nsec);
  return stamp;
}

StampedPose parse_row(Fields& fields, Warnings& warnings) {
  if (fields.count() != 8)
    fields.fail(
        fmt::format("expected 8 fields (stamp x y z qx qy qz qw), found {}", fields.count()));
  const std::string_view text = fields.word();
  const auto stamp = parse_stamp(text);
  if (!stamp) fields.fail(fmt::format("found stamp '{}', expected seconds", quoted(text)));
  if (stamp->sec >= latest_second)
    fields.fail(
        fmt::format("found stamp '{}', expected seconds; are these nanoseconds?", quoted(text)));
  return {*stamp, read_pose(fields, warnings)};
}

}  // namespace

std::vector<StampedPose> parse_tum(std::string_view text, const std::filesystem::path& where) {
  std::vector<StampedPose> out;
  Warnings rounding;  // a row has no place for warnings; poses are unit either way
  for_each_line(text, where, [&](std::string_view line, const LineOrigin& origin) {
    if (line[0] == '#') return;
    Fields fields(line, origin);
    out.push_back(parse_row(fields, rounding));
  });
  return out;
}

std::vector<StampedPose> read_tum(const std::filesystem::path& path) {
  return parse_tum(read_file(path), path);
}

std::string format_tum(const std::vector<StampedPose>& poses) {
  std::string out = "# timestamp x y z qx qy qz qw\n";
  for (const auto& [stamp, T_map_node] : poses) {
    out += fmt::format("{}.{:09}", stamp.sec, stamp.nsec);
    for (int i = 0; i < 3; ++i) out += ' ' + format_number(T_map_node.t[i]);
    for (int i = 0; i < 4; ++i) out += ' ' + format_number(T_map_node.q.coeffs()[i]);
    out += '\n';
  }
  return out;
}

}  // namespace cambium
