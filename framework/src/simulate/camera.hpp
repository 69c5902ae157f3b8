// SPDX-License-Identifier: BSD-3-Clause
// A camera that looks where the robot goes. Pinhole, no distortion; grey, 8 bits.
#pragma once
#include <string>

#include "simulate/random.hpp"
#include "simulate/scene.hpp"

namespace cambium::simulate {

/// Row by row from the upper left.
struct Picture {
  int columns = 0, rows = 0;
  std::string grey;
};

class Camera {
 public:
  explicit Camera(const CameraSpec& spec) : spec_(spec) {}

  /// Bark and ground carry a texture that belongs to the place, so that two pictures of a stem show
  /// the same bark. Leaves are not drawn. `stream` is that of the node: it gives the pixel noise.
  Picture look(const Scene& scene, const SE3& T_world_base, const Random& stream) const;

 private:
  CameraSpec spec_;
};

/// A PNG file of the picture, uncompressed (RFC 2083, with stored blocks of RFC 1951).
std::string png_of(const Picture& picture);

}  // namespace cambium::simulate
