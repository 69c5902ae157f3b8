// SPDX-License-Identifier: BSD-3-Clause
#include "plugins/handshake.hpp"

#include <gtest/gtest.h>

#include <cstring>

#include "cambium/error.hpp"

namespace cambium {
namespace {

constexpr PluginDescriptor good{
    sizeof(PluginDescriptor), api_major, api_minor, this_abi(), "p", "1.0.0", nullptr};

std::string refusal(const PluginDescriptor& plugin, const HostAbi& host = {},
                    std::size_t size = sizeof(PluginDescriptor)) {
  try {
    check_descriptor({reinterpret_cast<const char*>(&plugin), size}, "lib/p.so", host);
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ErrorCode::plugin);
    EXPECT_EQ(e.where(), "lib/p.so");
    return e.message();
  }
  return "";
}

TEST(Handshake, accepts_its_own_build) { EXPECT_EQ(refusal(good), ""); }

TEST(Handshake, refuses_each_field_by_name_with_both_values) {
  const std::pair<const char*, std::uint32_t AbiStamp::*> fields[] = {
      {"size", &AbiStamp::size},
      {"compiler_abi", &AbiStamp::compiler_abi},
      {"libstdcxx_cxx11", &AbiStamp::libstdcxx_cxx11},
      {"libstdcxx_debug", &AbiStamp::libstdcxx_debug},
      {"eigen_version", &AbiStamp::eigen_version},
      {"eigen_max_align", &AbiStamp::eigen_max_align},
      {"heap_align", &AbiStamp::heap_align},
      {"eigen_malloc", &AbiStamp::eigen_malloc},
      {"sanitizer", &AbiStamp::sanitizer},
      {"headers", &AbiStamp::headers}};
  // A field that is added to the stamp must be compared, too.
  static_assert(sizeof(AbiStamp) == std::size(fields) * sizeof(std::uint32_t));
  for (const auto& [name, field] : fields) {
    PluginDescriptor plugin = good;
    plugin.abi.*field += 4711;
    const std::string expected = std::string(name) + ": the plugin has " +
                                 std::to_string(plugin.abi.*field) + ", this Cambium " +
                                 std::to_string(good.abi.*field) + "; build";
    EXPECT_EQ(refusal(plugin).substr(0, expected.size()), expected);
  }
}

TEST(Handshake, compares_the_size_of_the_stamp_before_its_other_fields) {
  PluginDescriptor plugin = good;
  plugin.abi.size += 4;
  plugin.abi.eigen_version += 1;
  EXPECT_EQ(refusal(plugin).substr(0, 5), "size:");
}

TEST(Handshake, takes_older_minor_versions_down_to_the_oldest) {
  const HostAbi host{2, 5, 3, this_abi()};
  PluginDescriptor plugin = good;
  const auto at = [&](std::uint32_t major, std::uint32_t minor) {
    plugin.api_major = major;
    plugin.api_minor = minor;
    return refusal(plugin, host);
  };
  for (const std::uint32_t minor : {3, 4, 5}) EXPECT_EQ(at(2, minor), "");
  EXPECT_NE(at(2, 2).find("API 2.2, this Cambium runs 2.3 to 2.5; build"), std::string::npos);
  EXPECT_NE(at(1, 9).find("API 1.9, this Cambium runs 2.3 to 2.5; build"), std::string::npos);
  EXPECT_NE(at(2, 6).find("API 2.6, this Cambium runs 2.3 to 2.5; update"), std::string::npos);
  EXPECT_NE(at(3, 0).find("API 3.0, this Cambium runs 2.3 to 2.5; update"), std::string::npos);
}

TEST(Handshake, reads_no_further_than_the_plugin_says) {
  PluginDescriptor plugin = good;
  plugin.size = 4;
  EXPECT_NE(refusal(plugin).find("the plugin has 4 bytes"), std::string::npos);
  plugin.size = sizeof plugin - 8;
  EXPECT_NE(refusal(plugin).find("descriptor size"), std::string::npos);
  EXPECT_NE(refusal(good, {}, 8).find("the plugin has 8 bytes"), std::string::npos);
  plugin.size = sizeof plugin + 64;  // a plugin with fields that this host does not know yet
  EXPECT_EQ(refusal(plugin), "");
}

}  // namespace
}  // namespace cambium
