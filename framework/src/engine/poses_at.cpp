// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "cambium/error.hpp"
#include "cambium/fused.hpp"
#include "cambium/path.hpp"
#include "engine/split.hpp"
#include "io/fields.hpp"

namespace cambium {
namespace {

constexpr std::int64_t second = 1'000'000'000;

std::vector<StampedPose> in_time(std::vector<StampedPose> poses) {
  std::stable_sort(poses.begin(), poses.end(),
                   [](const StampedPose& a, const StampedPose& b) { return a.stamp < b.stamp; });
  return poses;
}

/// The two poses around a stamp, and its share of the time between them.
struct Between {
  const StampedPose *before, *after;
  double share;
};

std::optional<Between> around(const std::vector<StampedPose>& poses, const Stamp& stamp) {
  const auto after = std::lower_bound(
      poses.begin(), poses.end(), stamp,
      [](const StampedPose& pose, const Stamp& value) { return pose.stamp < value; });
  if (after == poses.end()) return std::nullopt;
  if (after->stamp == stamp) return Between{&*after, &*after, 0};
  if (after == poses.begin()) return std::nullopt;
  const auto before = std::prev(after);
  return Between{
      &*before, &*after,
      seconds_between(before->stamp, stamp) / seconds_between(before->stamp, after->stamp)};
}

std::optional<SE3> on_geodesic(const std::vector<StampedPose>& poses, const Stamp& stamp) {
  const auto b = around(poses, stamp);
  if (!b) return std::nullopt;
  return interpolate(b->before->T_map_node, b->after->T_map_node, b->share);
}

std::optional<std::int64_t> whole(std::string_view text) {
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || error != std::errc{} || end != text.data() + text.size() || value < 0)
    return std::nullopt;
  return value;
}

std::optional<Stamp> stamp_of(const std::vector<std::string_view>& words) {
  const auto first = whole(words[0]);
  constexpr std::int64_t latest_second = 100'000'000'000;
  if (first && *first >= latest_second)
    return Stamp{*first / second, std::int32_t(*first % second)};
  if (first && words.size() > 1)
    if (const auto nsec = whole(words[1]); nsec && *nsec < second)
      return Stamp{*first, std::int32_t(*nsec)};
  if (first) return Stamp{*first, 0};
  const auto point = words[0].find('.');
  if (point == words[0].npos) return std::nullopt;
  std::string fraction(words[0].substr(point + 1, 9));
  fraction.resize(9, '0');
  const auto sec = whole(words[0].substr(0, point)), nsec = whole(fraction);
  if (!sec || !nsec) return std::nullopt;
  return Stamp{*sec, std::int32_t(*nsec)};
}

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> out;
  for (std::size_t at = 0; at < line.size();) {
    const std::size_t begin = line.find_first_not_of(", \t;", at);
    if (begin == line.npos) break;
    at = std::min(line.find_first_of(", \t;", begin), line.size());
    out.push_back(line.substr(begin, at - begin));
  }
  return out;
}

}  // namespace

std::vector<Stamp> parse_stamps(std::string_view text, const std::filesystem::path& where) {
  std::vector<Stamp> out;
  for_each_line(text, where, [&](std::string_view line, const LineOrigin& origin) {
    const unsigned char head = static_cast<unsigned char>(line[0]);
    if (head == '#' || std::isalpha(head)) return;
    const auto words = words_of(line);
    const auto stamp = words.empty() ? std::nullopt : stamp_of(words);
    if (!stamp)
      throw Error(ErrorCode::data, origin.where(),
                  fmt::format("found '{}', expected a stamp: seconds, sec,nsec or nanoseconds",
                              quoted(line)));
    out.push_back(*stamp);
  });
  return out;
}

Interpolator::Interpolator(const MissionState& state, std::vector<StampedPose> odometry)
    : path_(in_time(trajectory(state))), odometry_(in_time(std::move(odometry))) {}

std::optional<SE3> Interpolator::T_map_base(const Stamp& stamp) const {
  const auto b = around(path_, stamp);
  if (!b) return std::nullopt;
  const auto first = on_geodesic(odometry_, b->before->stamp), now = on_geodesic(odometry_, stamp),
             last = on_geodesic(odometry_, b->after->stamp);
  if (!first || !now || !last)
    return interpolate(b->before->T_map_node, b->after->T_map_node, b->share);
  const SE3 followed = b->before->T_map_node * (first->inverse() * *now);
  const SE3 arrived = b->before->T_map_node * (first->inverse() * *last);
  const Vec6 missing = (arrived.inverse() * b->after->T_map_node).log();
  return followed * SE3::exp(b->share * missing);
}

}  // namespace cambium
