# SPDX-License-Identifier: BSD-3-Clause
"""The rules of docs/developing.md that a machine can check. Each returns what breaks it."""

import re
import subprocess
from pathlib import Path

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')
HEAVY = re.compile(r"^(pcl|ceres|opencv2?|gtsam|g2o)/")
SPDX = "SPDX-License-Identifier: BSD-3-Clause"
FOLDERS = ("framework", "plugins", "tests", "bench")


def sources(root, *folders):
    """C++ files below the folders, in a fixed order."""
    files = (f for folder in folders for f in Path(root, folder).rglob("*"))
    return sorted(f for f in files if f.suffix in (".cpp", ".hpp"))


def includes(file):
    """(line number, quoted, name) of every include."""
    for number, line in enumerate(file.read_text().splitlines(), 1):
        if match := INCLUDE.match(line):
            yield number, match[1] == '"', match[2]


def is_standard(name):
    return re.fullmatch(r"[a-z_]+", name) is not None


def public_headers(root):
    """The public API needs the standard library and Eigen only."""
    for file in sources(root, "framework/include"):
        for line, quoted, name in includes(file):
            own = quoted and name.startswith("cambium/")
            if not own and (quoted or not (is_standard(name) or name.startswith("Eigen/"))):
                yield f"{file}:{line}: includes {name}; expected the standard library, Eigen or cambium/"


def heavy_libraries(root):
    """PCL, Ceres, OpenCV, GTSAM and g2o stay in plugins."""
    for file in sources(root, "framework", "tests"):
        for line, _, name in includes(file):
            if HEAVY.match(name):
                yield f"{file}:{line}: includes {name}, which only plugins may"


def plugin_folders(root):
    """plugins/<kind>/<name> of plugins; a folder that several share makes no plugin."""
    for lists in sorted(Path(root, "plugins").glob("*/*/CMakeLists.txt")):
        if "cambium_add_plugin(" in lists.read_text():
            yield lists.parent


def plugin_includes(root):
    """A plugin sees cambium/, its own files, what its kind shares, and its own libraries."""
    src = Path(root, "framework/src")
    for file in sources(root, "plugins"):
        kind = Path(root, "plugins", *file.relative_to(Path(root, "plugins")).parts[:1])
        for line, quoted, name in includes(file):
            foreign = ".." in Path(name).parts or (src / name).exists()
            if quoted and not foreign:
                own = (file.parent / name).exists()
                shared = name.startswith("common/") and (kind / name).exists()
                # What tests share may stand in a header: a plugin's own target finds no support/.
                of_tests = file.name.endswith("test.cpp") or file.suffix == ".hpp"
                test = of_tests and name.startswith("support/")
                foreign = not (own or shared or test or name.startswith("cambium/"))
            if foreign:
                yield f"{file}:{line}: includes {name}; expected cambium/ or a file of the same plugin"


def plugin_files(root):
    """A plugin comes with a README and a test."""
    for folder in plugin_folders(root):
        for name in ("README.md", "test.cpp"):
            if not (folder / name).exists():
                yield f"{folder}: has no {name}"


def licence_lines(root):
    """The licence stands in the first line, behind the #! of a script."""
    for file in sorted(f for folder in FOLDERS for f in Path(root, folder).rglob("*")):
        if file.suffix not in (".cpp", ".hpp", ".cmake", ".in", ".py", ".sh"):
            if file.name != "CMakeLists.txt":
                continue
        lines = file.read_text().splitlines()[:2] + [""]
        if SPDX not in lines[1 if lines[0].startswith("#!") else 0]:
            yield f"{file}:1: expected '{SPDX}'"


def exported_symbols(folder):
    """A plugin exports its descriptor and nothing else: other symbols could meet their namesakes."""
    for library in sorted(Path(folder).glob("*.so")):
        nm = subprocess.run(["nm", "-D", "--defined-only", "--format=posix", library],
                            capture_output=True, text=True, check=True)
        names = [line.split()[0] for line in nm.stdout.splitlines()]
        if names != ["cambium_plugin"]:
            yield f"{library}: exports {', '.join(names) or 'nothing'}; expected cambium_plugin only"


TREE_RULES = (public_headers, heavy_libraries, plugin_includes, plugin_files, licence_lines)
