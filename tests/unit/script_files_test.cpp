// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/script_files.hpp"

#include "cambium/files.hpp"
#include "support/support.hpp"

namespace cambium {
namespace {

using testing::TemporaryFolder;

std::vector<std::string> names(const TemporaryFolder& folder) {
  std::vector<std::string> out;
  for (const auto& file : script_files(folder / "main.py")) out.push_back(file.filename().string());
  return out;
}

TEST(ScriptFiles, WhatIsNamedBesideAndWhatThatNames) {
  const TemporaryFolder folder;
  write_file(folder / "main.py", "import numpy\nfrom zebra import f\n");
  write_file(folder / "zebra.py", "def f():\n    import apple, main\n");
  write_file(folder / "apple.py", "apples = 1\n");
  write_file(folder / "apples.py", "apples of no word of their own");  // named by apple.py
  write_file(folder / "zebras.py", "");
  write_file(folder / "f.txt", "");
  EXPECT_EQ(names(folder),
            (std::vector<std::string>{"main.py", "apple.py", "apples.py", "zebra.py"}));
}

TEST(ScriptFiles, ContentsAndNamesCountNotPlaces) {
  const auto digest = [](const std::string& helper, const std::string& content) {
    const TemporaryFolder folder;
    write_file(folder / "main.py", "import one, two");
    write_file(folder / helper, content);
    return digest_script(folder / "main.py");
  };
  EXPECT_EQ(digest("one.py", "1"), digest("one.py", "1"));
  EXPECT_NE(digest("one.py", "1"), digest("one.py", "2"));
  EXPECT_NE(digest("one.py", "1"), digest("two.py", "1"));
  EXPECT_EQ(digest("three.py", "1"), digest("three.py", "2"));
}

}  // namespace
}  // namespace cambium
