# SPDX-License-Identifier: BSD-3-Clause
"""A partner's view: Cambium installed, the pages docs/write-a-plugin.md and docs/tutorial.md, and nothing else.

Arguments: the source folder, the build folder, and the name of a shipped plugin's folder that must
also build outside the tree.
"""

import json
import os
import shutil
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

import missions

sys.path.insert(0, str(Path(__file__).parent.parent / "docs"))
import page  # noqa: E402


def run(*command, **options):
    done = subprocess.run(command, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          **options)
    if done.returncode:
        raise AssertionError(f"{' '.join(map(str, command))}\n{done.stdout}")
    return done.stdout


KINDS = ("mission_reader", "payload_filter", "place_recognizer", "registration", "loop_verifier",
         "solver", "gnss_aligner", "map_exporter", "evaluator")


class Partner(unittest.TestCase):
    source = build = shipped = None

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.work = Path(folder.name)
        cls.prefix = cls.work / "prefix"
        run("cmake", "--install", cls.build, "--prefix", cls.prefix)
        cls.environment = {**os.environ, "CMAKE_PREFIX_PATH": str(cls.prefix),
                           "PATH": f"{cls.prefix / 'bin'}:{os.environ['PATH']}"}
        cls.environment["CAMBIUM_CACHE"] = str(cls.work / "cache")
        cls.environment.pop("CAMBIUM_PLUGIN_PATH", None)
        cls.page = Path(cls.source, "docs/write-a-plugin.md").read_text()

    def shell(self, commands, folder):
        return run("bash", "-euo", "pipefail", "-c", commands, cwd=folder, env=self.environment)

    def test_page_shows_the_files_of_the_example(self):
        shown = page.files(self.page)
        self.assertEqual(sorted(shown), ["CMakeLists.txt", "ring_key.cpp", "ring_key.yaml"])
        for name, content in shown.items():
            self.assertEqual(content, Path(self.source, "tests/partner_plugin", name).read_text(), name)
        self.assertLessEqual(len(shown["ring_key.cpp"].splitlines()), 60)

    def test_following_the_page_gives_a_run(self):
        folder = self.work / "ring_key"
        folder.mkdir()
        for name, content in page.files(self.page).items():
            (folder / name).write_text(content)
        missions.write_mission(folder / "mission_a", 10, heading=0.0, seed=2)
        missions.write_mission(folder / "mission_b", 10, heading=1.0, seed=3)
        to_do = self.page.split("## What the plugin consists of")[0]
        self.assertRegex(self.shell(page.commands(to_do), folder), r"ring_key +Points per ring")
        self.check_ledger(folder / "fused/ledger.jsonl")

    def test_the_tutorial_word_for_word(self):
        """A new user's shell: each block of the page as it comes, files written where the commands have led to."""
        folder = self.work / "tutorial"
        folder.mkdir()
        script, text = [], Path(self.source, "docs/tutorial.md").read_text()
        for number, block in enumerate(page.blocks(text)):
            self.assertIn(block.language, ("sh", "cpp", "yaml"))
            if block.file:
                (folder / f"block_{number}").write_text(block.content)
                script.append(f"cp {folder}/block_{number} {block.file}\n")
            else:
                script.append(block.content)
        began = time.monotonic()
        said = self.shell("".join(script), folder)
        print(f"docs/tutorial.md: {time.monotonic() - began:.0f} s of commands")
        self.assertIn("100% tests passed", said)
        self.assertLess(len(page.files(text)["my_method.cpp"].splitlines()), 40)
        table = (folder / "my_method/table/results.md").read_text()
        for row in ("my_method", "wide", "scan_context"):
            self.assertRegex(table, rf"(?m)^\| [^|]*{row}[^|]* \| ok \| .*\d")
        results = json.loads((folder / "my_method/table/results.json").read_text())
        self.assertEqual(results["findings"], [])

    def check_ledger(self, ledger):
        """Nodes of one number stand at one place; most must find each other."""
        loops = [json.loads(line) for line in ledger.read_text().splitlines()]
        self.assertEqual({loop["proposed_by"] for loop in loops}, {"ring_key"})
        found = {loop["tail"]["id"] for loop in loops if loop["tail"]["id"] == loop["head"]["id"]}
        self.assertGreaterEqual(len(found), 8, f"of 10 nodes; {len(loops)} proposals")
        self.assertLessEqual(len(loops), 30, "three candidates for each of ten nodes")

    def test_an_installed_plugin_is_found_without_a_path(self):
        example = Path(self.source, "tests/partner_plugin")
        for command in (("-S", example, "-B", self.work / "b"), ("--build", self.work / "b"),
                        ("--install", self.work / "b", "--prefix", self.prefix)):
            run("cmake", *command, env=self.environment)
        self.addCleanup(lambda: next(self.prefix.rglob("ring_key.so")).unlink())
        self.assertIn("ring_key", self.shell("cambium plugins list", self.work))

    def test_pkg_config_and_components_lead_to_the_same_plugin(self):
        folder = self.work / "by_hand"
        folder.mkdir()
        shutil.copy(Path(self.source, "tests/partner_plugin/ring_key.cpp"), folder)
        found = next(self.prefix.rglob("cambium.pc")).parent
        versions = Path(self.source, "docs/versions.md").read_text()
        self.shell(f"export PKG_CONFIG_PATH={found}\n{page.commands(versions)}"
                   "cambium plugins check ring_key.so\n", folder)
        (folder / "CMakeLists.txt").write_text(
            "cmake_minimum_required(VERSION 3.25)\nproject(p LANGUAGES CXX)\n"
            "find_package(cambium 0.1 REQUIRED COMPONENTS plugin program)\n"
            "find_package(cambium 0.1 COMPONENTS no_such_part)\n"
            "if(cambium_FOUND)\n  message(FATAL_ERROR found)\nendif()\n")
        self.shell("cmake -S . -B build", folder)

    def test_abi_is_told_field_by_field(self):
        said = self.shell("cambium --version --abi", self.work)
        self.assertRegex(said, r"^cambium 0\.1\.0\napi 0\.1, plugins from 0\.1 on\nsize \d+\n")
        self.assertRegex(said, r"\neigen_version 304\d\d\n")
        self.assertRegex(said, r"\nheaders \d+\n")
        self.assertEqual(self.shell("cambium --version", self.work), "cambium 0.1.0\n")

    def test_new_plugins_of_every_kind_build_keep_the_laws_and_run(self):
        folder = self.work / "new"
        folder.mkdir()
        for kind in KINDS:
            self.shell(f"cambium plugins new {kind} new_{kind}", folder)
            (folder / f"new_{kind}" / "missions").symlink_to("../missions")
        (folder / "CMakeLists.txt").write_text(
            "cmake_minimum_required(VERSION 3.25)\nproject(all LANGUAGES CXX)\nenable_testing()\n"
            + "".join(f"add_subdirectory(new_{kind})\n" for kind in KINDS))
        self.shell("cmake -S . -B build -DCMAKE_BUILD_TYPE=Release\ncmake --build build -j2\n"
                   "ctest --test-dir build -j2 --output-on-failure\n"
                   "cambium simulate new_solver/forest.yaml missions", folder)
        for kind in KINDS:
            self.shell(f"cambium run new_{kind}/new_{kind}.yaml --out out_{kind} "
                       f"--plugin-path build/new_{kind}/new_{kind}.so", folder)
            steps = json.loads((folder / f"out_{kind}/report.json").read_text())["steps"]
            if kind != "mission_reader":
                self.assertIn(f"new_{kind}", [step["plugin"] for step in steps])

    def test_a_shipped_plugin_builds_outside_the_tree(self):
        name = Path(self.shipped).name
        folder = self.work / "shipped" / name
        shutil.copytree(Path(self.source, self.shipped), folder)
        library = next(self.prefix.rglob(f"{name}.so"))
        shutil.copy(library, self.work)
        self.addCleanup(lambda: shutil.copy(self.work / f"{name}.so", library))
        self.shell("cmake -S . -B build -DCMAKE_BUILD_TYPE=Release\ncmake --build build\n"
                   f"find {self.prefix} -name {name}.so -delete\n", folder)
        listed = self.shell(f"cambium plugins list --plugin-path build/{name}.so", folder)
        self.assertIn(name, listed)


if __name__ == "__main__":
    Partner.source, Partner.build, Partner.shipped = sys.argv[1:4]
    unittest.main(argv=sys.argv[:1], verbosity=2)
