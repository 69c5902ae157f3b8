// SPDX-License-Identifier: BSD-3-Clause
#include "kitti.hpp"

#include <charconv>
#include <cmath>
#include <sstream>

#include "cambium/error.hpp"
#include "cambium/files.hpp"

namespace trajectory {

using namespace cambium;

namespace {

[[noreturn]] void fail(const std::filesystem::path& path, int line, const std::string& what) {
  throw Error(ErrorCode::data, path.string() + ":" + std::to_string(line), what);
}

/// The numbers of every line that is not blank, and its number in the file.
std::vector<std::pair<int, std::vector<double>>> rows(const std::filesystem::path& path,
                                                      std::size_t expected, const char* what) {
  std::vector<std::pair<int, std::vector<double>>> out;
  std::istringstream lines(read_file(path));
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    std::istringstream words(line);
    std::vector<double> values;
    for (std::string word; words >> word;) {
      double value = 0;
      const char* const end = word.data() + word.size();
      const auto result = std::from_chars(word.data(), end, value);
      if (result.ec != std::errc{} || result.ptr != end || !std::isfinite(value))
        fail(path, number, "found '" + word.substr(0, 40) + "', expected a finite number");
      values.push_back(value);
    }
    if (values.empty()) continue;
    if (values.size() != expected)
      fail(path, number,
           "expected " + std::to_string(expected) + " numbers (" + what + "), found " +
               std::to_string(values.size()));
    out.emplace_back(number, std::move(values));
  }
  return out;
}

SE3 pose_of(const std::filesystem::path& path, int line, const std::vector<double>& v) {
  Mat4 T = Mat4::Identity();
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 4; ++c) T(r, c) = v[std::size_t(4 * r + c)];
  const Mat3 R = T.topLeftCorner<3, 3>();
  const double off = (R.transpose() * R - Mat3::Identity()).cwiseAbs().maxCoeff();
  if (off > 1e-3 || R.determinant() < 0)
    fail(path, line, "its 3x3 part is no rotation; are the numbers row by row?");
  return SE3::from_matrix(T);
}

Stamp stamp_of(const std::filesystem::path& path, int line, double seconds) {
  if (seconds < 0 || seconds > 1e11) fail(path, line, "expected seconds, zero or above");
  Stamp out;
  out.sec = std::int64_t(seconds);
  out.nsec = std::int32_t(std::lround((seconds - double(out.sec)) * 1e9));
  if (out.nsec == 1'000'000'000) ++out.sec, out.nsec = 0;
  return out;
}

}  // namespace

std::vector<KittiPose> read_kitti(const std::filesystem::path& path,
                                  const std::filesystem::path& times) {
  std::vector<KittiPose> out;
  for (const auto& [line, values] : rows(path, 12, "[R t] row by row"))
    out.push_back({{}, pose_of(path, line, values)});
  if (times.empty()) return out;
  const auto stamps = rows(times, 1, "a stamp in seconds");
  if (stamps.size() != out.size())
    throw Error(ErrorCode::data, times.string(),
                "holds " + std::to_string(stamps.size()) + " stamps, but " + path.string() + " " +
                    std::to_string(out.size()) + " poses");
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i].stamp = stamp_of(times, stamps[i].first, stamps[i].second[0]);
  return out;
}

SE3 base_from_camera(const SE3& T_first_camera) {
  Mat4 T_base_camera = Mat4::Identity();
  T_base_camera.topLeftCorner<3, 3>() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  const SE3 turn = SE3::from_matrix(T_base_camera);
  return turn * T_first_camera * turn.inverse();
}

}  // namespace trajectory
