// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <filesystem>

namespace cambium::python {

/// Whether the name is that of a ROS recording: .bag, .mcap, .db3, or a folder with such files that
/// is no mission folder.
bool is_recording(const std::filesystem::path& path);

}  // namespace cambium::python
