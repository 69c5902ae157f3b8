// SPDX-License-Identifier: BSD-3-Clause
// A payload that stays on disk until someone wants it.
#pragma once
#include <filesystem>
#include <mutex>

#include "cambium/payload.hpp"

namespace cambium {

class FilePayload final : public PayloadSource {
 public:
  /// Either path may be empty: the node has no such payload.
  FilePayload(std::filesystem::path cloud, std::filesystem::path trees, bool apply_viewpoint)
      : cloud_(std::move(cloud)), trees_(std::move(trees)), apply_viewpoint_(apply_viewpoint) {}

  Payload load() const override;
  Digest digest() const override;  ///< of the files, computed when first asked for
  std::string where() const override { return (cloud_.empty() ? trees_ : cloud_).string(); }

 private:
  std::filesystem::path cloud_, trees_;
  bool apply_viewpoint_;
  mutable std::once_flag digest_once_;
  mutable Digest digest_;
};

}  // namespace cambium
