// SPDX-License-Identifier: BSD-3-Clause
// A payload that stays on disk until someone wants it.
#pragma once
#include <filesystem>
#include <mutex>

#include "cambium/payload.hpp"
#include "payload_check.hpp"

namespace cambium {

class FilePayload final : public PayloadSource {
 public:
  /// Any path may be empty: the node has no such payload.
  FilePayload(PayloadPaths paths, bool apply_viewpoint)
      : paths_(std::move(paths)), apply_viewpoint_(apply_viewpoint) {}

  Payload load() const override;
  Digest digest() const override;  ///< of the files, computed when first asked for
  std::string where() const override;

 private:
  PayloadPaths paths_;
  bool apply_viewpoint_;
  mutable std::once_flag digest_once_;
  mutable Digest digest_;
};

}  // namespace cambium
