# SPDX-License-Identifier: BSD-3-Clause
"""Every code block of every page: C++ and Python compile, CMake runs, YAML is valid, JSON parses, data reads, command
lines are what the programs take. A block that is no whole says so, with the reason, behind its language.

Arguments: the program, the source folder, then the compiler with the flags for the public headers.
"""

import ast
import json
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import commands
import page

FEW = 6  # blocks that may be left out, over all pages

CMAKE_PRELUDE = "".join(f"function({name})\nendfunction()\n" for name in (
    "project", "find_package", "cambium_add_plugin", "cambium_test_plugin", "enable_testing"))


class Docs(unittest.TestCase):
    program = source = compiler = None

    @classmethod
    def setUpClass(cls):
        places = ("README.md", "docs/*.md", "docs/decisions/*.md", "plugins/*/*/README.md")
        cls.pages = {p: page.blocks(p.read_text()) for place in places for p in sorted(cls.source.glob(place))}
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.work = Path(folder.name)

    def each(self, check, *languages):
        """check(content, folder) of every block of these languages; the folder has the files of its page."""
        for path, found in self.pages.items():
            for block in found:
                if block.language in languages and not block.fragment:
                    with self.subTest(f"{path.relative_to(self.source)}:{block.line}"):
                        check(block, self.folder_of(path))

    def folder_of(self, path):
        folder = self.work / re.sub(r"\W", "_", str(path.relative_to(self.source)))
        if not folder.exists():
            folder.mkdir()
            for block in self.pages[path]:
                if block.file:
                    (folder / block.file).write_text(block.content)
            small = self.source / "plugins/place_recognizer/learned_bev/model/small.onnx"
            (folder / "my_network.onnx").write_bytes(small.read_bytes())
        return folder

    def run_quietly(self, *command, code=0):
        done = subprocess.run([str(word) for word in command], text=True, capture_output=True)
        self.assertEqual(done.returncode, code, f"{command}\n{done.stdout}{done.stderr}")
        return done

    def test_every_block_says_what_it_is_and_few_are_left_out(self):
        known = {"sh", "cpp", "cmake", "yaml", "json", "python", "text", "g2o", "trees", "gnss"}
        left_out = []
        for path, found in self.pages.items():
            for block in found:
                place = f"{path.relative_to(self.source)}:{block.line}"
                self.assertIn(block.language, known, place)
                if block.fragment:
                    left_out.append(place)
                    self.assertGreater(len(block.fragment), 15, f"{place}: the reason is missing")
                if block.language == "text":  # commands belong into sh, where they are checked
                    self.assertNotRegex(block.content, r"(?m)^(build/bin/)?cambium [a-z]", place)
        self.assertLessEqual(len(left_out), FEW, left_out)

    def test_cpp(self):
        self.each(self.check_cpp, "cpp")

    def check_cpp(self, block, folder):
        (folder / "block.cpp").write_text(block.content)
        self.run_quietly(*self.compiler, "-std=c++20", "-fsyntax-only", "-Wall", "-Wextra", folder / "block.cpp")

    def test_python(self):
        self.each(lambda block, _: ast.parse(block.content), "python")

    def test_json(self):
        self.each(lambda block, _: json.loads(block.content), "json")

    def test_cmake(self):
        self.each(self.check_cmake, "cmake")

    def check_cmake(self, block, folder):
        (folder / "block.cmake").write_text(CMAKE_PRELUDE + block.content)
        self.run_quietly("cmake", "-P", folder / "block.cmake")

    def test_yaml(self):
        self.each(self.check_yaml, "yaml")

    def check_yaml(self, block, folder):
        kind = ("simulation" if re.search(r"^(stand|sensor):", block.content, re.MULTILINE) else
                "matrix" if re.search(r"^datasets:", block.content, re.MULTILINE) else "pipeline")
        getattr(self, f"check_{kind}")(block.content, folder)

    def check_pipeline(self, content, folder):
        if content.lstrip().startswith("- "):  # some steps
            content = "version: 1\nsteps:\n" + content
        (folder / "block.yaml").write_text(content)
        if content.startswith(("version", "#")) and "recognize: ring_key" in content:
            return self.check_only_the_unknown("ring_key", folder)
        self.run_quietly(self.program, "validate", folder / "block.yaml")

    def check_only_the_unknown(self, plugin, folder):
        """The plugin of the page itself is not there; all else must be right."""
        said = self.run_quietly(self.program, "validate", folder / "block.yaml", code=2).stderr
        self.assertEqual(said.count("block.yaml:"), 1, said)
        self.assertIn(f"'{plugin}'", said)

    def check_simulation(self, content, folder):
        (folder / "block.yaml").write_text(content)
        self.run_quietly(self.program, "simulate", folder / "block.yaml", folder / "simulated")

    def check_matrix(self, content, folder):
        """Against the schema; what it names lies elsewhere."""
        schema = json.loads(self.run_quietly(self.program, "matrix", "--schema").stdout)
        keys = re.findall(r"^(\w+):", content, re.MULTILINE)
        self.assertTrue(keys)
        self.assertEqual(set(keys) - set(schema["properties"]), set())

    def test_data(self):
        self.each(self.check_data, "g2o", "trees", "gnss")

    def check_data(self, block, folder):
        mission = folder / "mission"
        (mission / "individual_trees").mkdir(parents=True, exist_ok=True)
        names = {"g2o": "slam_pose_graph.g2o", "gnss": "gnss.csv",
                 "trees": "individual_trees/trees_1683269382_051793003.csv"}
        (mission / names[block.language]).write_text(block.content)
        self.run_quietly(self.program, "inspect", mission)

    def test_commands(self):
        self.each(self.check_commands, "sh")

    def check_commands(self, block, _):
        done = subprocess.run(["bash", "-n"], input=block.content, text=True, capture_output=True)
        self.assertEqual(done.stderr, "")
        for words in commands.simple_commands(block.content):
            self.assertEqual(commands.wrong(words, self.program, self.source), "", " ".join(words))

    def test_the_check_itself_notices(self):
        """Wrong options, words and files are found."""
        check = lambda text: commands.wrong(commands.simple_commands(text)[0], self.program, self.source)
        self.assertIn("--outt", check("cambium run a.yaml --outt fused"))
        self.assertIn("subcommand", check("cambium plann x.yaml"))
        self.assertIn("has no pipelines/none.yaml", check("cambium run pipelines/none.yaml"))
        self.assertIn("no such bench", check("build/bin/bench_none 3"))
        self.assertIn("bootstrap knows", check("./bootstrap everything"))
        self.assertEqual(check("A=1 cambium run a.yaml --out b > log  # and so on"), "")


if __name__ == "__main__":
    Docs.program, Docs.source, Docs.compiler = sys.argv[1], Path(sys.argv[2]), sys.argv[3:]
    unittest.main(argv=sys.argv[:1], verbosity=2)
