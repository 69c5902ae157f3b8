// SPDX-License-Identifier: BSD-3-Clause
// Clouds set upright, as every descriptor of heights wants them.
#pragma once
#include <span>

#include "cambium/atlas.hpp"

namespace columns {

/// The smallest rotation that sets the base upright: p_level = q_level_base * p_base. It does not
/// depend on the heading. T_mission_node's frame has z against gravity.
cambium::Quat level_rotation(const cambium::SE3& T_mission_node);

/// The finite points of the cloud in the levelled frame.
cambium::Cloud::Matrix3X levelled(const cambium::Cloud& cloud, const cambium::Quat& q_level_base);

/// A rotation in the four floats of a fingerprint (x y z w), and back as T_level_base.
constexpr std::size_t rotation_size = 4;
void write_rotation(const cambium::Quat& q_level_base, std::span<float> to);
cambium::SE3 T_level_base(std::span<const float> rotation);

/// What descriptors of a node start from: the finite points of its cloud, set upright by roll and
/// pitch of the node when `level`; none when it has no cloud. The rotation goes to `rotation`.
cambium::Cloud::Matrix3X upright_points(const cambium::MissionView& mission, std::size_t node,
                                        bool level, std::span<float> rotation);

}  // namespace columns
