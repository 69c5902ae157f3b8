// SPDX-License-Identifier: BSD-3-Clause
#include "features.hpp"

#include <algorithm>
#include <cstring>
#include <opencv2/features2d.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "cambium/error.hpp"
#include "common/opencv.hpp"

namespace visual_bow {
namespace {

using cambium::Error;
using cambium::ErrorCode;

cv::Mat grey_picture(const std::filesystem::path& path) try {
  const cv::Mat out = cv::imread(path.string(), cv::IMREAD_GRAYSCALE);
  if (out.empty())
    throw Error(ErrorCode::data, path.string(),
                "cannot be read as a picture, expected a whole JPEG, PNG or WebP file");
  return out;
} catch (const cv::Exception& e) {
  throw Error(ErrorCode::data, path.string(), "cannot be read as a picture: " + e.err);
}

}  // namespace

std::vector<columns::Bits> features_of(const std::filesystem::path& picture,
                                       const FeatureOptions& options) {
  columns::quiet_opencv();
  cv::Mat image = grey_picture(picture);
  const double scale = double(options.max_side) / std::max(image.rows, image.cols);
  if (scale < 1) cv::resize(image, image, {}, scale, scale, cv::INTER_AREA);
  const auto orb = cv::ORB::create(options.count, 1.2f, 8, 31, 0, 2, cv::ORB::HARRIS_SCORE, 31,
                                   options.threshold);
  std::vector<cv::KeyPoint> corners;
  cv::Mat rows;
  orb->detectAndCompute(image, cv::noArray(), corners, rows);
  std::vector<columns::Bits> out(std::size_t(rows.rows));
  for (int i = 0; i < rows.rows; ++i)
    std::memcpy(out[std::size_t(i)].data(), rows.ptr(i), sizeof(columns::Bits));
  std::ranges::sort(out);  // a bag knows no order
  return out;
}

}  // namespace visual_bow
