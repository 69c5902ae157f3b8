// SPDX-License-Identifier: BSD-3-Clause
// The g2o dialect of mission folders (docs/formats.md). Nothing is dropped: lines that the model
// has no place for are kept; numbers are written so that they read back bit for bit.
#pragma once
#include <filesystem>
#include <iosfwd>
#include <string_view>

#include "cambium/mission.hpp"

namespace cambium {

/// Parses a pose graph. `where` names it in messages. Throws Error(data, "where:line").
Mission parse_g2o(std::string_view text, const std::filesystem::path& where);
Mission read_g2o(const std::filesystem::path& path);  ///< throws Error(data)

void write_g2o(std::ostream& out, const Mission& mission);

/// Of what a mission says: name, platform, poses, edges, georeference, fixes, kept lines. Not of
/// payloads, and not of paths, line numbers and warnings, so that a moved folder stays the same.
/// The parsers above fill in Mission::digest; who changes a mission afterwards calls this again.
Digest mission_digest(const Mission& mission);

/// The shortest decimal form that reads back bit for bit.
std::string format_number(double value);

}  // namespace cambium
