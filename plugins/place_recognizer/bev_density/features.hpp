// SPDX-License-Identifier: BSD-3-Clause
// ORB features of pictures, and how fingerprints hold them. OpenCV stays behind this header.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "common/hamming.hpp"
#include "picture.hpp"

namespace bev_density {

/// The corners of a picture (ORB: Rublee, Rabaud, Konolige, Bradski, ICCV 2011), row i each.
struct Features {
  std::vector<std::array<float, 3>> at;  ///< in the levelled frame, z of the column's bottom [m]
  std::vector<columns::Bits> bits;       ///< turn with the corner's own orientation
  std::size_t size() const { return at.size(); }
};

struct FeatureOptions {
  int count = 200;     ///< the strongest corners that are kept
  int threshold = 10; ///< of FAST: by how much a corner differs from the pixels around it
  int patch = 31;      ///< pixels around a corner that are described
};

/// In order of y, then x.
Features find_features(const Picture& picture, const PictureGrid& grid,
                       const FeatureOptions& options);

/// Two features that look more like each other than like any other of the other picture.
struct FeatureMatch {
  std::size_t query = 0, reference = 0;
  int distance = 0;  ///< bits that differ
};

/// Those with at most `max_distance` bits of 256, the most alike first.
std::vector<FeatureMatch> match_features(const Features& query, const Features& reference,
                                         int max_distance);

}  // namespace bev_density
