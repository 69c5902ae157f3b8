// SPDX-License-Identifier: BSD-3-Clause
// The points of one tile, which stay on disk until someone wants them.
#pragma once
#include <filesystem>
#include <mutex>

#include "cambium/payload.hpp"
#include "common/las_header.hpp"
#include "file_system.hpp"

namespace las_tiles {

class TilePayload final : public cambium::PayloadSource {
 public:
  /// The node stands at `t_mission_node`, without a turn.
  TilePayload(std::filesystem::path path, las::Header header, Frame frame,
              const cambium::Vec3& t_mission_node)
      : path_(std::move(path)),
        header_(std::move(header)),
        frame_(std::move(frame)),
        t_mission_node_(t_mission_node) {}

  cambium::Payload load() const override;
  cambium::Digest digest() const override;
  std::string where() const override { return path_.string(); }

 private:
  std::filesystem::path path_;
  las::Header header_;
  Frame frame_;
  cambium::Vec3 t_mission_node_;
  mutable std::once_flag digest_once_;
  mutable cambium::Digest digest_;
};

}  // namespace las_tiles
