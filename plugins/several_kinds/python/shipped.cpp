// SPDX-License-Identifier: BSD-3-Clause
#include "shipped.hpp"

#include <dlfcn.h>

#include <filesystem>

namespace cambium::python {

std::string shipped_folder() {
  Dl_info library{};
  dladdr(reinterpret_cast<const void*>(&shipped_folder), &library);
  const std::filesystem::path path(library.dli_fname ? library.dli_fname : "");
  return (std::filesystem::absolute(path).parent_path() / "python").string();
}

std::pair<std::string, std::string> shipped_script(const std::string& name) {
  const std::size_t colon = name.find(':');
  return {shipped_folder() + "/" + name.substr(0, colon), name.substr(colon + 1)};
}

}  // namespace cambium::python
