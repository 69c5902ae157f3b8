// SPDX-License-Identifier: BSD-3-Clause
#include "file_payload.hpp"

#include "cloud_file.hpp"
#include "tree_file.hpp"

namespace cambium {

Payload FilePayload::load() const {
  Payload payload;
  if (!paths_.cloud.empty())
    payload.cloud = std::make_shared<const Cloud>(load_cloud(paths_.cloud, apply_viewpoint_).cloud);
  if (!paths_.trees.empty())
    payload.trees = std::make_shared<const std::vector<Tree>>(load_trees(paths_.trees));
  if (!paths_.image.empty())
    payload.images = std::make_shared<const std::vector<Image>>(1, Image{paths_.image, {}});
  return payload;
}

std::string FilePayload::where() const {
  for (const auto& path : {paths_.cloud, paths_.trees, paths_.image})
    if (!path.empty()) return path.string();
  return {};
}

Digest FilePayload::digest() const {
  std::call_once(digest_once_, [this] {
    Hasher hasher;
    hasher.add(apply_viewpoint_ ? "viewpoint" : "as it is");
    for (const auto& path : {paths_.cloud, paths_.trees, paths_.image})
      hasher.add(path.empty() ? Digest{} : digest_file(path));
    digest_ = hasher.digest();
  });
  return digest_;
}

}  // namespace cambium
