// SPDX-License-Identifier: BSD-3-Clause
#include "payload_check.hpp"

#include "cambium/error.hpp"
#include "cloud_file.hpp"
#include "payload_files.hpp"
#include "tree_file.hpp"

namespace cambium {
namespace {

struct Finding {
  std::size_t not_finite = 0;
  bool empty = false;
  std::vector<std::string> errors;
};

Finding look_at(const PayloadPaths& paths, bool apply_viewpoint) {
  Finding found;
  if (!paths.cloud.empty()) try {
      const LoadedCloud loaded = load_cloud(paths.cloud, apply_viewpoint);
      found.not_finite = loaded.not_finite;
      found.empty = loaded.cloud.empty();
    } catch (const Error& error) {
      found.errors.push_back(error.what());
    }
  if (!paths.trees.empty()) try {
      load_trees(paths.trees);
    } catch (const Error& error) {
      found.errors.push_back(error.what());
    }
  return found;
}

}  // namespace

void check_payloads(const std::vector<PayloadPaths>& nodes, bool apply_viewpoint,
                    const Context& context, std::vector<std::string>& warnings) {
  std::vector<Finding> found(nodes.size());
  context.parallel_for(nodes.size(), [&](std::size_t i) {
    context.check_cancelled();
    found[i] = look_at(nodes[i], apply_viewpoint);
  });
  std::vector<std::string> empty, with_nan;
  std::size_t not_finite = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const std::string name = nodes[i].cloud.filename().string();
    if (found[i].empty) empty.push_back(name);
    if (found[i].not_finite > 0) with_nan.push_back(name);
    not_finite += found[i].not_finite;
    warnings.insert(warnings.end(), found[i].errors.begin(), found[i].errors.end());
  }
  if (!empty.empty()) warnings.push_back(with_first_names("clouds are empty", empty));
  if (!with_nan.empty())
    warnings.push_back(with_first_names("clouds hold NaN or infinite points, of which " +
                                            std::to_string(not_finite) + " are removed",
                                        with_nan));
}

}  // namespace cambium
