// SPDX-License-Identifier: BSD-3-Clause
#include "engine/program.hpp"

#include <dlfcn.h>

#include "cambium/kinds.hpp"

namespace cambium {

std::string program_version() { return CAMBIUM_VERSION; }

std::filesystem::path program_path() { return std::filesystem::read_symlink("/proc/self/exe"); }

const Digest& program_build() {
  static const Digest build = [] {
    Dl_info library{};  // whichever file holds a symbol of libcambium
    dladdr(reinterpret_cast<const void*>(&digest_bytes), &library);
    return Hasher().add(digest_file(program_path())).add(digest_file(library.dli_fname)).digest();
  }();
  return build;
}

}  // namespace cambium
