// SPDX-License-Identifier: BSD-3-Clause
// One mission, read as the command line says.
#pragma once
#include <filesystem>
#include <functional>
#include <string>

#include "engine/engine.hpp"
#include "pipeline/yaml.hpp"
#include "plugins/loader.hpp"

namespace cambium::cli {

struct WhatToRead {
  std::filesystem::path path;
  std::string reader;         ///< empty: the one that knows the format
  std::string params = "{}";  ///< of the reader, YAML; what --params says
};

/// Sets a plain value in `params`, in place of one that is there.
void set_param(Yaml& params, const std::string& name, const std::string& value,
               const std::string& where);
/// The same if the reader has such a parameter and `params` does not set it.
void set_if_known(Component& reader, Yaml& params, const std::string& name,
                  const std::string& value);

/// `adjust` may change the parameters before they are bound. Throws Error.
Mission read_one(const WhatToRead& what, const std::function<void(Component&, Yaml&)>& adjust,
                 const Registry& registry, const Engine& engine);

}  // namespace cambium::cli
