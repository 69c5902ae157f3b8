// SPDX-License-Identifier: BSD-3-Clause
// ORB features of a picture file. OpenCV stays behind this header.
#pragma once
#include <filesystem>
#include <vector>

#include "common/hamming.hpp"

namespace visual_bow {

struct FeatureOptions {
  int count = 500;     ///< the strongest corners that are kept, over all scales
  int threshold = 20;  ///< of FAST: by how much a corner differs from the pixels around it, of 255
  int max_side = 640;  ///< larger pictures are scaled down to it [pixels]
};

/// Descriptors of the corners (ORB: Rublee, Rabaud, Konolige, Bradski, ICCV 2011), in ascending
/// order. Throws Error(data) when the file is no picture that OpenCV reads.
std::vector<columns::Bits> features_of(const std::filesystem::path& picture,
                                       const FeatureOptions& options);

}  // namespace visual_bow
