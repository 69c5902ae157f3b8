// SPDX-License-Identifier: BSD-3-Clause
#include "support/places.hpp"

namespace cambium::testing {

namespace fs = std::filesystem;

fs::path source(const std::string& relative) { return fs::path(CAMBIUM_SOURCE_DIR) / relative; }

fs::path built(const std::string& relative) { return fs::path(CAMBIUM_BUILD_DIR) / relative; }

fs::path plugin_folder() { return CAMBIUM_TEST_PLUGINS; }

}  // namespace cambium::testing
