// SPDX-License-Identifier: BSD-3-Clause
// OpenCV inside a plugin. A header alone, so that plugins without OpenCV do not meet it.
#pragma once
#include <opencv2/core.hpp>
#include <opencv2/core/utils/logger.hpp>

namespace columns {

/// Call it before anything else of OpenCV: the host has the threads, and the messages; OpenCV would
/// start its own and print.
inline void quiet_opencv() {
  static const bool once = [] {
    cv::setNumThreads(1);
    cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
    cv::redirectError([](int, const char*, const char*, const char*, int, void*) { return 0; });
    return true;
  }();
  (void)once;
}

}  // namespace columns
