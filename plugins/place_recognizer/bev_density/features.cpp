// SPDX-License-Identifier: BSD-3-Clause
#include "features.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <opencv2/features2d.hpp>
#include <tuple>

#include "common/opencv.hpp"

namespace bev_density {
namespace {

/// Height of the picture's bottom around a corner, which may itself be between points [m].
float bottom_near(const Picture& picture, int col, int row) {
  float out = std::numeric_limits<float>::infinity();
  for (int r = std::max(row - 2, 0); r <= std::min(row + 2, picture.side - 1); ++r)
    for (int c = std::max(col - 2, 0); c <= std::min(col + 2, picture.side - 1); ++c)
      out = std::fmin(out, picture.bottom[std::size_t(r * picture.side + c)]);  // skips NaN
  return std::isfinite(out) ? out : 0.0f;
}

}  // namespace

Features find_features(const Picture& picture, const PictureGrid& grid,
                       const FeatureOptions& options) {
  columns::quiet_opencv();
  const cv::Mat inside(picture.side, picture.side, CV_8U,
                       const_cast<std::uint8_t*>(picture.brightness.data()));
  // ORB leaves out what is nearer to the rim than a patch reaches; around the circle all is dark.
  const int rim = options.patch;
  cv::Mat image;
  cv::copyMakeBorder(inside, image, rim, rim, rim, rim, cv::BORDER_CONSTANT);
  const auto orb = cv::ORB::create(options.count, 1.2f, 1, options.patch, 0, 2,
                                   cv::ORB::HARRIS_SCORE, options.patch, options.threshold);
  std::vector<cv::KeyPoint> corners;
  cv::Mat descriptors;
  orb->detectAndCompute(image, cv::noArray(), corners, descriptors);
  std::vector<std::size_t> order(corners.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::sort(order, {},
                    [&](std::size_t i) { return std::tuple(corners[i].pt.y, corners[i].pt.x, i); });
  Features out;
  for (const std::size_t i : order) {
    const int col = int(corners[i].pt.x) - rim, row = int(corners[i].pt.y) - rim;
    out.at.push_back({float((col + 0.5 - 0.5 * picture.side) * grid.cell),
                      float((row + 0.5 - 0.5 * picture.side) * grid.cell),
                      bottom_near(picture, col, row)});
    std::memcpy(out.bits.emplace_back().data(), descriptors.ptr(int(i)), sizeof(columns::Bits));
  }
  return out;
}

std::vector<FeatureMatch> match_features(const Features& query, const Features& reference,
                                         int max_distance) {
  const auto [of_query, of_reference] = columns::nearest_bits(query.bits, reference.bits);
  std::vector<FeatureMatch> out;
  for (std::size_t q = 0; q < query.size(); ++q)
    if (const auto& [r, distance] = of_query[q];
        distance <= max_distance && of_reference[r].index == q)
      out.push_back({q, r, distance});
  std::ranges::stable_sort(out, {}, &FeatureMatch::distance);
  return out;
}

}  // namespace bev_density
