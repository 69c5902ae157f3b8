// SPDX-License-Identifier: BSD-3-Clause
#include "plugins/handshake.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstring>

#include "cambium/error.hpp"

namespace cambium {
namespace {

struct Field {
  const char* name;
  std::uint32_t AbiStamp::*value;
  const char* what_to_do;
};

// The size stands first: when it differs, the other fields need not be what their offsets say.
constexpr Field fields[] = {
    {"size", &AbiStamp::size, "build the plugin against the headers of this Cambium"},
    {"compiler_abi", &AbiStamp::compiler_abi,
     "build both with compilers of the same -fabi-version (g++ of the same major version)"},
    {"libstdcxx_cxx11", &AbiStamp::libstdcxx_cxx11,
     "build both with the same _GLIBCXX_USE_CXX11_ABI"},
    {"libstdcxx_debug", &AbiStamp::libstdcxx_debug,
     "build both with, or both without, _GLIBCXX_DEBUG"},
    {"eigen_version", &AbiStamp::eigen_version, "build both with the same Eigen"},
    {"eigen_max_align", &AbiStamp::eigen_max_align,
     "build the plugin without -mavx, -mavx2, -mavx512f or -march=native, or define "
     "EIGEN_MAX_STATIC_ALIGN_BYTES as the host has it"},
    {"heap_align", &AbiStamp::heap_align, "build both for the same platform"},
    {"eigen_malloc", &AbiStamp::eigen_malloc,
     "build both with the same EIGEN_MALLOC_ALREADY_ALIGNED"},
    {"sanitizer", &AbiStamp::sanitizer,
     "build both with the same sanitizer (0 none, 1 address, 2 thread)"},
    {"headers", &AbiStamp::headers,
     "build the plugin against the headers of this Cambium; they declare something else"}};

void check_api(const PluginDescriptor& plugin, const std::string& library, const HostAbi& host) {
  const bool newer = plugin.api_major > host.major ||
                     (plugin.api_major == host.major && plugin.api_minor > host.minor);
  const bool older = plugin.api_major < host.major || plugin.api_minor < host.minor_oldest;
  if (!newer && !older) return;
  throw Error(
      ErrorCode::plugin, library,
      fmt::format("api: the plugin was built for API {}.{}, this Cambium runs {}.{} to {}.{}; {}",
                  plugin.api_major, plugin.api_minor, host.major, host.minor_oldest, host.major,
                  host.minor,
                  newer ? "update Cambium, or build the plugin against this one"
                        : "build the plugin again, against this Cambium"));
}

void check_size(std::size_t size, std::size_t least, const std::string& library) {
  if (size >= least) return;
  throw Error(ErrorCode::plugin, library,
              fmt::format("descriptor size: the plugin has {} bytes, this Cambium needs at least "
                          "{}; build the plugin against the headers of this Cambium",
                          size, least));
}

}  // namespace

void check_descriptor(std::string_view descriptor, const std::string& library,
                      const HostAbi& host) {
  PluginDescriptor plugin{};
  std::memcpy(&plugin, descriptor.data(), std::min(descriptor.size(), sizeof plugin));
  const std::size_t size = std::min<std::size_t>(plugin.size, descriptor.size());
  check_size(size, offsetof(PluginDescriptor, abi), library);
  check_api(plugin, library, host);
  for (const Field& field : fields) {
    const auto theirs = plugin.abi.*field.value, ours = host.abi.*field.value;
    if (theirs != ours)
      throw Error(ErrorCode::plugin, library,
                  fmt::format("{}: the plugin has {}, this Cambium {}; {}", field.name, theirs,
                              ours, field.what_to_do));
  }
  check_size(size, sizeof plugin, library);
}

std::string abi_text(const HostAbi& host) {
  std::string out = fmt::format("api {}.{}, plugins from {}.{} on\n", host.major, host.minor,
                                host.major, host.minor_oldest);
  for (const Field& field : fields)
    out += fmt::format("{} {}\n", field.name, host.abi.*field.value);
  return out;
}

}  // namespace cambium
