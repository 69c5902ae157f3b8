// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "common/surface.hpp"

namespace cambium::registration {

/// The vertical in the base frame, from what a cloud shows: the direction that ground normals
/// point along and that normals of walls and stems are square to. Found when the z axis of the
/// base frame is up to within some 20 degrees, as on anything that walks, drives or is carried.
Eigen::Vector3f vertical(const Patches& patches);

/// Turns `up` onto the z axis without a turn about it: R_level_base.
Eigen::Matrix3f levelling(const Eigen::Vector3f& up);

}  // namespace cambium::registration
