// SPDX-License-Identifier: BSD-3-Clause
#include "plugins/search_path.hpp"

#include "cambium/error.hpp"
#include "support/support.hpp"

namespace cambium {
namespace {

namespace fs = std::filesystem;

class SearchPath : public ::testing::Test {
 protected:
  fs::path folder(const std::string& name) {
    fs::create_directories(root / name);
    return fs::canonical(root / name);
  }
  testing::TemporaryFolder root;
  fs::path program = folder("bin") / "cambium";
};

TEST_F(SearchPath, keeps_the_order_named_variable_installed) {
  const auto installed = folder("lib/cambium/plugins");
  const auto a = folder("a"), b = folder("b"), c = folder("c");
  const auto path = plugin_search_path({c.string()}, b.string() + ":" + a.string(), program);
  EXPECT_EQ(path, (std::vector{c, b, a, installed}));
}

TEST_F(SearchPath, names_a_folder_once) {
  const auto a = folder("a");
  const auto path = plugin_search_path({a.string() + "/", (a / "../a").string()}, a, program);
  EXPECT_EQ(path, std::vector{a});
}

TEST_F(SearchPath, never_holds_the_current_folder) {
  const auto a = folder("a");
  const std::string variable = std::string(":").append(a.string()).append("::");
  EXPECT_EQ(plugin_search_path({}, variable, program), std::vector{a});
  EXPECT_TRUE(plugin_search_path({}, "", program).empty());
}

TEST_F(SearchPath, refuses_what_does_not_exist_and_what_is_relative) {
  EXPECT_THROW(plugin_search_path({(root / "absent").string()}, "", program), Error);
  EXPECT_THROW(plugin_search_path({}, (root / "absent").string(), program), Error);
  EXPECT_THROW(plugin_search_path({}, ".", program), Error);
}

TEST_F(SearchPath, finds_an_installation_in_the_system_s_library_folder) {
  const auto installed = folder(CAMBIUM_LIBDIR "/cambium/plugins");
  EXPECT_EQ(plugin_search_path({}, "", program), std::vector{installed});
}

}  // namespace
}  // namespace cambium
