// SPDX-License-Identifier: BSD-3-Clause
// Every refusal names the path, the cause and what to do, and leaves nothing behind.
#include "plugins/loader.hpp"

#include <cstdlib>

#include "cambium/files.hpp"
#include "support/places.hpp"
#include "support/support.hpp"

namespace cambium {
namespace {

namespace fs = std::filesystem;
using testing::TemporaryFolder;

const fs::path fixtures = testing::built("tests/bad_plugins/libraries");

fs::path fixture(const std::string& name) { return fixtures / (name + ".so"); }

struct Refusal {
  const char* fixture;
  std::vector<std::string> words;  ///< what the message must hold, besides the path
};
void PrintTo(const Refusal& r, std::ostream* out) { *out << r.fixture; }

class Refused : public ::testing::TestWithParam<Refusal> {};

void expect_refusal(const fs::path& library, const std::vector<std::string>& words) {
  PluginLoader loader;
  try {
    loader.load_file(library);
    FAIL() << library << " was loaded";
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ErrorCode::plugin);
    EXPECT_EQ(e.where(), library.string());
    for (const auto& word : words)
      EXPECT_NE(e.message().find(word), std::string::npos) << "'" << word << "' in: " << e.what();
  }
  EXPECT_TRUE(loader.registry().all().empty());
  EXPECT_TRUE(loader.plugins().empty());
}

TEST_P(Refused, names_path_cause_and_what_to_do) {
  expect_refusal(fixture(GetParam().fixture), GetParam().words);
}

INSTANTIATE_TEST_SUITE_P(
    Fixtures, Refused,
    ::testing::Values(
        Refusal{"no_symbol", {"without the symbol 'cambium_plugin'", "use CAMBIUM_PLUGIN"}},
        Refusal{"function_symbol", {"not as data", "cambium_add_plugin()"}},
        Refusal{"newer_api", {"api", "API 0.2", "runs 0.1", "update Cambium"}},
        Refusal{"older_api", {"api", "API 0.0", "runs 0.1", "build the plugin again"}},
        Refusal{"other_alignment", {"eigen_max_align", "has 32", "Cambium 16", "without -mavx"}},
        Refusal{"throws_in_fill", {"'throws_in_fill'", "calibration file is missing", "author"}},
        Refusal{"duplicate_inside", {"'twice'", "already provided", "rename"}},
        Refusal{"no_component", {"no component", "author"}},
        Refusal{"missing_dependency", {"libbad_gone.so", "cannot open shared object", "ldd"}}),
    [](const auto& info) { return std::string(info.param.fixture); });

TEST(Loader, nothing_of_a_plugin_runs_before_it_is_known_to_fit) {
  for (const char* name : {"newer_api", "older_api", "other_alignment"}) {
    PluginLoader loader;
    EXPECT_THROW(loader.load_file(fixture(name)), Error);
    EXPECT_EQ(std::getenv((std::string("CAMBIUM_FIXTURE_") + name).c_str()), nullptr) << name;
  }
  PluginLoader().load_file(fixture("good"));
  EXPECT_STREQ(std::getenv("CAMBIUM_FIXTURE_good"), "opened");
}

TEST(Loader, stamps_where_a_component_comes_from) {
  PluginLoader loader;
  loader.load_file(fixture("good"));
  const Registered* found = loader.registry().find(Kind::payload_filter, "unchanged");
  ASSERT_NE(found, nullptr);
  EXPECT_EQ(found->plugin, "good");
  EXPECT_EQ(found->plugin_version, "1.2.3");
  EXPECT_EQ(found->library, fixture("good").string());
  EXPECT_EQ(found->build, digest_file(fixture("good")));
  EXPECT_NE(found->create(), nullptr);
}

TEST(Loader, a_stripped_library_is_as_good) {
  PluginLoader loader;
  loader.load_file(fixture("good_stripped"));
  EXPECT_NE(loader.registry().find(Kind::payload_filter, "unchanged"), nullptr);
}

TEST(Loader, components_outlive_the_loader) {
  std::unique_ptr<Component> component;
  {
    PluginLoader loader;
    loader.load_file(fixture("good"));
    component = loader.registry().find(Kind::payload_filter, "unchanged")->create();
  }
  EXPECT_EQ(component->check_params(), "");
}

TEST(Loader, a_duplicate_names_both_libraries_and_leaves_nothing_behind) {
  PluginLoader loader;
  loader.load_file(fixture("good"));
  try {
    loader.load_file(fixture("duplicate_name"));
    FAIL() << "a duplicate was loaded";
  } catch (const Error& e) {
    EXPECT_EQ(e.where(), fixture("duplicate_name").string());
    EXPECT_NE(e.message().find(fixture("good").string()), std::string::npos) << e.what();
    EXPECT_NE(e.message().find("rename"), std::string::npos) << e.what();
  }
  EXPECT_EQ(loader.registry().find(Kind::payload_filter, "another"), nullptr);
  EXPECT_EQ(loader.plugins().size(), 1u);
}

TEST(Loader, the_same_library_under_another_path_is_no_duplicate) {
  const TemporaryFolder folder;
  fs::create_symlink(fixture("good"), folder / "link.so");
  fs::copy_file(fixture("good"), folder / "copy.so");
  PluginLoader loader;
  loader.load_file(fixture("good"));
  loader.load_folder(folder.path());
  EXPECT_EQ(loader.plugins().size(), 1u);
  EXPECT_TRUE(loader.refusals().empty());
}

TEST(Loader, a_file_that_is_no_library_is_refused) {
  const TemporaryFolder folder;
  write_file(folder / "text.so", "INPUT(libcambium.so)\n");
  write_file(folder / "empty.so", "");
  for (const char* name : {"text.so", "empty.so"})
    expect_refusal(folder / name, {"is not a shared library", "cambium_add_plugin()"});
  expect_refusal(folder / "absent.so", {"is not a file", "expected a plugin library"});
}

TEST(Loader, a_library_cut_short_anywhere_is_refused) {
  const TemporaryFolder folder;
  const std::string whole = read_file(fixture("good_stripped"));
  // From the end of the ELF header to the last byte: the section table stands at the end.
  for (std::size_t size = 64; size < whole.size(); size += 997) {
    const auto library = folder / (std::to_string(size) + ".so");
    write_file(library, whole.substr(0, size));
    expect_refusal(library, {"is cut short", std::to_string(size) + " bytes"});
  }
}

TEST(Loader, one_bad_library_in_a_folder_does_not_stop_the_others) {
  const TemporaryFolder folder;
  fs::copy_file(fixture("good"), folder / "b.so");
  write_file(folder / "a.so", "no library");
  write_file(folder / "readme.txt", "not looked at");
  PluginLoader loader;
  loader.load_folder(folder.path());
  EXPECT_EQ(loader.plugins().size(), 1u);
  ASSERT_EQ(loader.refusals().size(), 1u);
  EXPECT_EQ(loader.refusals()[0].where(), (folder / "a.so").string());
  EXPECT_THROW(loader.load_folder(folder / "absent"), Error);
}

TEST(Loader, two_libraries_of_a_folder_with_one_name_are_an_error) {
  PluginLoader loader;
  EXPECT_THROW(loader.load_folder(fixtures), Error);
}

}  // namespace
}  // namespace cambium
