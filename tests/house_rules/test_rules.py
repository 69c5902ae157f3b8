# SPDX-License-Identifier: BSD-3-Clause
"""Runs the rules over this tree, and over a tree that breaks every one of them.

Arguments: the source folder, the folder with the built plugins.
"""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import rules

LICENSED = f"// {rules.SPDX}\n"


class ThisTree(unittest.TestCase):
    root = plugins = None

    def test_keeps_every_rule(self):
        for rule in rules.TREE_RULES:
            with self.subTest(rule.__name__):
                broken = list(rule(self.root))
                self.assertFalse(broken, "\n".join([rule.__doc__, *broken]))

    def test_has_plugins_that_export_one_symbol(self):
        self.assertTrue(list(Path(self.plugins).glob("*.so")), f"no plugin built in {self.plugins}")
        self.assertEqual(list(rules.exported_symbols(self.plugins)), [])


class BrokenTree(unittest.TestCase):
    """A rule that never fires proves nothing."""

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.root = Path(self.folder.name)

    def write(self, path, text):
        file = self.root / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)

    def expect(self, rule, *places):
        """The rule names these places, in this order, and no other."""
        found = [line.split(": ")[0] for line in rule(self.root)]
        self.assertEqual(found, [str(self.root / place) for place in places])

    def test_public_headers(self):
        self.write("framework/include/cambium/a.hpp",
                   '#include <vector>\n#include <Eigen/Core>\n#include "cambium/b.hpp"\n'
                   '#include <fmt/format.h>\n#include "plugins/loader.hpp"\n#include <unistd.h>\n')
        self.expect(rules.public_headers, *(f"framework/include/cambium/a.hpp:{n}" for n in (4, 5, 6)))

    def test_heavy_libraries(self):
        self.write("framework/src/a.cpp", "#include <vector>\n#include <pcl/point_types.h>\n")
        self.write("tests/unit/b.cpp", "#include <ceres/ceres.h>\n")
        self.write("plugins/solver/c/c.cpp", "#include <ceres/ceres.h>\n")
        self.expect(rules.heavy_libraries, "framework/src/a.cpp:2", "tests/unit/b.cpp:1")

    def test_plugin_includes(self):
        self.write("framework/src/engine/run.hpp", "")
        self.write("plugins/solver/other/other.hpp", "")
        self.write("plugins/solver/common/shared.hpp", "")
        self.write("plugins/solver/mine/own.hpp", "")
        self.write("plugins/solver/mine/mine.cpp",
                   '#include "own.hpp"\n#include "common/shared.hpp"\n#include "cambium/plugin.hpp"\n'
                   '#include "engine/run.hpp"\n#include <engine/run.hpp>\n'
                   '#include "../other/other.hpp"\n#include "other/other.hpp"\n'
                   '#include "support/support.hpp"\n')
        self.write("plugins/solver/mine/test.cpp", '#include "support/support.hpp"\n')
        self.expect(rules.plugin_includes, *(f"plugins/solver/mine/mine.cpp:{n}" for n in (4, 5, 6, 7, 8)))

    def test_plugin_files(self):
        self.write("plugins/solver/mine/CMakeLists.txt", "cambium_add_plugin(mine SOURCES mine.cpp)")
        self.write("plugins/solver/common/CMakeLists.txt", "add_library(common STATIC a.cpp)")
        self.expect(rules.plugin_files, "plugins/solver/mine", "plugins/solver/mine")

    def test_licence_lines(self):
        self.write("framework/a.cpp", LICENSED)
        self.write("framework/b.cpp", f"\n{LICENSED}")
        self.write("tests/c.py", f"#!/usr/bin/env python3\n# {rules.SPDX}\n")
        self.write("tests/CMakeLists.txt", "")
        self.expect(rules.licence_lines, "framework/b.cpp:1", "tests/CMakeLists.txt:1")

    def test_exported_symbols(self):
        source = "int cambium_plugin = 1;"
        for name, text in (("good", source), ("bad", source + " int another = 2;")):
            subprocess.run(["cc", "-shared", "-fPIC", "-nostartfiles", "-x", "c", "-",
                            "-o", self.root / f"{name}.so"], input=text, text=True, check=True)
        self.expect(rules.exported_symbols, "bad.so")


if __name__ == "__main__":
    ThisTree.root, ThisTree.plugins = sys.argv[1:3]
    unittest.main(argv=sys.argv[:1])
