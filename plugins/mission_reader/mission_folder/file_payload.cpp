// SPDX-License-Identifier: BSD-3-Clause
#include "file_payload.hpp"

#include "cloud_file.hpp"
#include "tree_file.hpp"

namespace cambium {

Payload FilePayload::load() const {
  Payload payload;
  if (!cloud_.empty())
    payload.cloud = std::make_shared<const Cloud>(load_cloud(cloud_, apply_viewpoint_).cloud);
  if (!trees_.empty())
    payload.trees = std::make_shared<const std::vector<Tree>>(load_trees(trees_));
  return payload;
}

Digest FilePayload::digest() const {
  std::call_once(digest_once_, [this] {
    Hasher hasher;
    hasher.add(apply_viewpoint_ ? "viewpoint" : "as it is");
    for (const auto& path : {cloud_, trees_})
      hasher.add(path.empty() ? Digest{} : digest_file(path));
    digest_ = hasher.digest();
  });
  return digest_;
}

}  // namespace cambium
