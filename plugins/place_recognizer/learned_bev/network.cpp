// SPDX-License-Identifier: BSD-3-Clause
#include "network.hpp"

#include <cmath>
#include <opencv2/dnn.hpp>

#include "cambium/error.hpp"
#include "common/opencv.hpp"

namespace learned_bev {
namespace {

using cambium::Error;
using cambium::ErrorCode;

}  // namespace

struct Network::Copy {
  cv::dnn::Net net;
};

Network::Network(std::string onnx, std::string where)
    : onnx_(std::move(onnx)), where_(std::move(where)) {
  columns::quiet_opencv();
  idle_.push_back(borrow());
}

Network::~Network() = default;

std::unique_ptr<Network::Copy> Network::borrow() const {
  {
    const std::lock_guard lock(mutex_);
    if (!idle_.empty()) {
      auto copy = std::move(idle_.back());
      idle_.pop_back();
      return copy;
    }
  }
  try {
    auto copy = std::make_unique<Copy>();
    copy->net = cv::dnn::readNetFromONNX(onnx_.data(), onnx_.size());
    copy->net.setPreferableBackend(cv::dnn::DNN_BACKEND_OPENCV);
    return copy;
  } catch (const cv::Exception& e) {
    throw Error(ErrorCode::data, where_,
                "OpenCV's dnn module cannot read this ONNX network: " + e.err +
                    "; export it with a lower opset (9 to 13) and static shapes, or run it with "
                    "onnxruntime from a Python script (docs/learned-recognisers.md)");
  }
}

std::vector<float> Network::run(std::span<const float> image, int rows, int cols) const {
  auto copy = borrow();
  std::vector<float> out;
  try {
    const int shape[] = {1, 1, rows, cols};
    copy->net.setInput(cv::Mat(4, shape, CV_32F, const_cast<float*>(image.data())));
    const cv::Mat result = copy->net.forward();
    if (result.type() != CV_32F || !result.isContinuous())
      throw Error(ErrorCode::data, where_, "gives something else than a tensor of float32");
    out.assign(result.ptr<float>(), result.ptr<float>() + result.total());
  } catch (const cv::Exception& e) {
    throw Error(ErrorCode::data, where_,
                "does not run on an image of 1 x 1 x " + std::to_string(rows) + " x " +
                    std::to_string(cols) + ": " + e.err +
                    "; set rows and cols to what the network expects");
  }
  {
    const std::lock_guard lock(mutex_);
    idle_.push_back(std::move(copy));
  }
  double squares = 0;
  for (const float value : out) squares += double(value) * value;
  if (!std::isfinite(squares))
    throw Error(ErrorCode::data, where_, "gives numbers that are not finite");
  if (squares > 0)
    for (float& value : out) value = float(value / std::sqrt(squares));
  return out;
}

}  // namespace learned_bev
