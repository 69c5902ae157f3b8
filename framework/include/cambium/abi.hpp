// SPDX-License-Identifier: BSD-3-Clause
// What must agree between a plugin and its host before any C++ object may cross between them.
// Everything here is a plain C struct: it is read before the plugin is trusted.
#pragma once
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include <Eigen/Core>

#include "cambium/api_digest.hpp"

namespace cambium {

inline constexpr std::uint32_t api_major = 0;  ///< another major version is refused
inline constexpr std::uint32_t api_minor = 1;  ///< a plugin may be older, never newer
/// The oldest minor version whose plugins still run. Raised whenever a signature or a type of the
/// API changes, which happens while the major version is 0.
inline constexpr std::uint32_t api_minor_oldest = 1;

struct AbiStamp {
  std::uint32_t size;               ///< sizeof(AbiStamp); compared first
  std::uint32_t compiler_abi;       ///< __GXX_ABI_VERSION
  std::uint32_t libstdcxx_cxx11;    ///< _GLIBCXX_USE_CXX11_ABI
  std::uint32_t libstdcxx_debug;    ///< _GLIBCXX_DEBUG changes the layout of containers
  std::uint32_t eigen_version;      ///< world * 10000 + major * 100 + minor
  std::uint32_t eigen_max_align;    ///< EIGEN_MAX_STATIC_ALIGN_BYTES; -mavx2 makes it 32
  std::uint32_t heap_align;         ///< alignof(std::max_align_t)
  std::uint32_t eigen_malloc;       ///< EIGEN_MALLOC_ALREADY_ALIGNED
  std::uint32_t sanitizer;          ///< bit 0 address, bit 1 thread
  std::uint32_t headers;            ///< api_digest: what the public headers declare
};

#if defined(__SANITIZE_ADDRESS__)
#define CAMBIUM_SANITIZER 1u
#elif defined(__SANITIZE_THREAD__)
#define CAMBIUM_SANITIZER 2u
#else
#define CAMBIUM_SANITIZER 0u
#endif
#if defined(_GLIBCXX_DEBUG)
#define CAMBIUM_LIBSTDCXX_DEBUG 1u
#else
#define CAMBIUM_LIBSTDCXX_DEBUG 0u
#endif

/// Static: every plugin must have its own copy, with the values of its own compilation.
static constexpr AbiStamp this_abi() {
  return {sizeof(AbiStamp),
          __GXX_ABI_VERSION,
          _GLIBCXX_USE_CXX11_ABI,
          CAMBIUM_LIBSTDCXX_DEBUG,
          EIGEN_WORLD_VERSION * 10000 + EIGEN_MAJOR_VERSION * 100 + EIGEN_MINOR_VERSION,
          EIGEN_MAX_STATIC_ALIGN_BYTES,
          alignof(std::max_align_t),
          EIGEN_MALLOC_ALREADY_ALIGNED,
          CAMBIUM_SANITIZER,
          api_digest};
}

class Registry;

/// Append only: a host reads no further than `size`.
struct PluginDescriptor {
  std::uint32_t size;
  std::uint32_t api_major, api_minor;
  AbiStamp abi;
  const char* name;
  const char* version;
  void (*fill)(Registry& registry);
};

}  // namespace cambium
