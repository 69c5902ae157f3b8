// SPDX-License-Identifier: BSD-3-Clause
// Decides from plain numbers whether a plugin and this host mean the same by every C++ type.
#pragma once
#include <string>
#include <string_view>

#include "cambium/abi.hpp"

namespace cambium {

/// The host's side of the handshake; the default is this process.
struct HostAbi {
  std::uint32_t major = api_major, minor = api_minor, minor_oldest = api_minor_oldest;
  AbiStamp abi = this_abi();
};

/// `descriptor` holds the bytes of the plugin's descriptor, `library` its path. Returns when the
/// plugin fits; throws Error(plugin) naming the path, the field, both values and what to do.
void check_descriptor(std::string_view descriptor, const std::string& library,
                      const HostAbi& host = {});

/// Both sides of the handshake must agree on these, one line each: "eigen_version 30400".
std::string abi_text(const HostAbi& host = {});

}  // namespace cambium
