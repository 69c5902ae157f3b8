// SPDX-License-Identifier: BSD-3-Clause
#include "gnss_file.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "common/csv_table.hpp"
#include "fix_quality.hpp"

namespace cambium {
namespace {

const std::vector<std::string> place = {"sec", "nsec", "lat", "lon", "alt"};
const std::vector<std::string> sigma = {"sd_e", "sd_n", "sd_u"};
const std::vector<std::string> covariance = {"cov_ee", "cov_en", "cov_eu",
                                             "cov_nn", "cov_nu", "cov_uu"};

Mat3 from_sigma(const CsvTable& table, std::size_t row) {
  Mat3 C = Mat3::Zero();
  for (int i = 0; i < 3; ++i) {
    const double sd = table.number(row, sigma[std::size_t(i)]);
    if (sd <= 0)
      table.fail(row,
                 "found " + sigma[std::size_t(i)] + " " + table.text(row, sigma[std::size_t(i)]) +
                     ", expected metres above 0; give an honest guess when the receiver gave none");
    C(i, i) = sd * sd;
  }
  return C;
}

Mat3 from_covariance(const CsvTable& table, std::size_t row) {
  Mat3 C;
  auto name = covariance.begin();
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j) C(i, j) = C(j, i) = table.number(row, *name++);
  if (Eigen::Matrix3d(C).llt().info() != Eigen::Success)
    table.fail(row, "the covariance is not positive definite, expected east, north, up in m^2");
  return C;
}

GnssFix fix_of(const CsvTable& table, std::size_t row) {
  GnssFix fix;
  fix.stamp.sec = table.integer(row, "sec");
  const std::int64_t nsec = table.integer(row, "nsec");
  if (nsec > 999'999'999)
    table.fail(row, "found nsec " + table.text(row, "nsec") + ", expected 0 to 999999999");
  fix.stamp.nsec = std::int32_t(nsec);
  fix.latitude = table.number(row, "lat");
  fix.longitude = table.number(row, "lon");
  fix.altitude = table.number(row, "alt");
  if (std::abs(fix.latitude) > 90 || std::abs(fix.longitude) > 360)
    table.fail(row, "expected lat -90..90 and lon -360..360 in degrees");
  return fix;
}

int quality_of(const CsvTable& table, std::size_t row) {
  const std::int64_t quality = table.integer(row, "quality");
  if (quality > 8)
    table.fail(row, "found quality " + table.text(row, "quality") +
                        ", expected that of a GGA sentence, 0 to 8");
  return int(quality);
}

}  // namespace

std::vector<GnssFix> load_fixes(const std::filesystem::path& path,
                                std::vector<std::string>& warnings) {
  const CsvTable table(path);
  table.require(place);
  std::vector<std::string> known = place;
  known.insert(known.end(), sigma.begin(), sigma.end());
  known.insert(known.end(), covariance.begin(), covariance.end());
  known.push_back("quality");
  table.allow_only(known);
  const bool has_covariance = table.has(covariance[0]), has_sigma = table.has(sigma[0]);
  if (has_covariance) table.require(covariance);
  if (has_sigma) table.require(sigma);
  const bool has_quality = table.has("quality");
  if (!has_covariance && !has_sigma && !has_quality)
    warnings.push_back(
        path.string() +
        ":1: no columns sd_e,sd_n,sd_u and no column quality; 1 m is taken for every fix");
  std::vector<GnssFix> fixes;
  std::size_t without_place = 0;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const int quality = has_quality ? quality_of(table, row) : 1;
    if (!measured(quality)) {
      ++without_place;
      continue;
    }
    fixes.push_back(fix_of(table, row));
    if (has_covariance)
      fixes.back().covariance = from_covariance(table, row);
    else if (has_sigma)
      fixes.back().covariance = from_sigma(table, row);
    else if (has_quality)
      fixes.back().covariance = covariance_of_quality(quality);
  }
  if (without_place > 0)
    warnings.push_back(path.string() + ": " + std::to_string(without_place) +
                       " rows whose quality says that nothing was measured are left out");
  std::stable_sort(fixes.begin(), fixes.end(),
                   [](const GnssFix& a, const GnssFix& b) { return a.stamp < b.stamp; });
  return fixes;
}

}  // namespace cambium
