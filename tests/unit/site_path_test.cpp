// SPDX-License-Identifier: BSD-3-Clause
#include <sys/stat.h>

#include "cambium/files.hpp"
#include "serve/site_path.hpp"
#include "support/support.hpp"

namespace cambium::testing {
namespace {

namespace fs = std::filesystem;
using serve::SitePath;
using serve::site_path;

/// A site beside a secret, with links of every kind.
class SitePathTest : public ::testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(root() / "tiles");
    fs::create_directories(root() / "empty");
    write_file(root() / "index.html", "page");
    write_file(root() / "tiles/r.bin", "points");
    write_file(root() / ".hidden", "none of the page's");
    write_file(folder_ / "secret", "secret");
    fs::create_directories(folder_ / "site_of_another");
    write_file(folder_ / "site_of_another/index.html", "another");
    fs::create_symlink(folder_ / "secret", root() / "out");
    fs::create_directory_symlink(folder_.path(), root() / "up");
    fs::create_symlink("r.bin", root() / "tiles/in");
  }
  fs::path root() const { return fs::canonical(folder_.path()) / "site"; }
  SitePath::Answer answer(const std::string& path) const { return site_path(root(), path).answer; }

  TemporaryFolder folder_;
};

TEST_F(SitePathTest, FilesOfTheFolder) {
  EXPECT_EQ(site_path(root(), "/").file, root() / "index.html");
  EXPECT_EQ(site_path(root(), "/tiles/r.bin").file, root() / "tiles/r.bin");
  EXPECT_EQ(site_path(root(), "/tiles/in").file, root() / "tiles/r.bin");
  EXPECT_EQ(answer("/tiles"), SitePath::Answer::redirect);
}

TEST_F(SitePathTest, NothingElse) {
  for (const char* path : {"/../secret", "/..", "/tiles/../../secret", "/tiles/..", "/./index.html",
                           "/.hidden", "/..\\secret", "/tiles\\r.bin", "/out", "/up/secret", "/up/",
                           "/up/site_of_another/", "index.html", "", "//../secret", "/tiles/..%2f..%2fsecret"})
    EXPECT_EQ(answer(path), SitePath::Answer::refused) << path;
  EXPECT_EQ(answer(std::string("/index.html\0.png", 16)), SitePath::Answer::refused);
  EXPECT_EQ(answer("/index.html\n"), SitePath::Answer::refused);
}

TEST_F(SitePathTest, WhatIsNotThere) {
  // Decoding happens once, before: these are names of files that nobody wrote.
  for (const char* path : {"/nothing", "/tiles/", "/empty/", "/index.html/", "/%2e%2e/secret"})
    EXPECT_EQ(answer(path), SitePath::Answer::absent) << path;
  ASSERT_EQ(::mkfifo((root() / "pipe").c_str(), 0600), 0);  // reading it would never end
  EXPECT_EQ(answer("/pipe"), SitePath::Answer::absent);
}

TEST_F(SitePathTest, AnIndexThatLeadsOutIsRefused) {
  fs::create_symlink(folder_ / "secret", root() / "empty/index.html");
  EXPECT_EQ(answer("/empty/"), SitePath::Answer::refused);
}

TEST(ContentType, IsThatOfTheExtension) {
  EXPECT_STREQ(serve::content_type("a/page.js"), "text/javascript; charset=utf-8");
  EXPECT_STREQ(serve::content_type("map.json"), "application/json");
  EXPECT_STREQ(serve::content_type("r.bin"), "application/octet-stream");
  EXPECT_STREQ(serve::content_type("x"), "application/octet-stream");
}

}  // namespace
}  // namespace cambium::testing
