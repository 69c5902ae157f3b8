# SPDX-License-Identifier: BSD-3-Clause
"""What the tests of recordings share."""

import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np


class Recordings(unittest.TestCase):
    program = source = None

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.work = Path(folder.name)

    def cambium(self, *command, code=0):
        done = subprocess.run([self.program, *map(str, command)], cwd=self.work, text=True, capture_output=True,
                              env={**os.environ, "VIRTUAL_ENV": sys.prefix})
        self.assertEqual(done.returncode, code, f"{command}\n{done.stdout}{done.stderr}")
        return done.stdout + done.stderr

    def bring_in(self, bag, *options, name="m", code=0):
        """`cambium import`; the mission folder. With another code: what it said, and nothing may be left."""
        said = self.cambium("import", bag, "--out", name, *options, code=code)
        if code == 0:
            return self.work / name
        self.assertFalse([p for p in self.work.iterdir() if p.name == name or p.name.startswith(".tmp")])
        return said


def nodes(mission):
    """[(sec, nsec, x, y, z, qx, qy, qz, qw)] of the pose graph."""
    lines = (mission / "slam_pose_graph.g2o").read_text().splitlines()
    rows = [line.split() for line in lines if line.startswith("VERTEX")]
    return [(int(r[9]), int(r[10]), *map(float, r[2:9])) for r in rows]


def cloud(path):
    """Columns of a binary PCD file, by name."""
    head, body = path.read_bytes().split(b"DATA binary\n", 1)
    words = {line.split()[0]: line.split()[1:] for line in head.decode().splitlines() if not line.startswith("#")}
    kinds = [(n, {"F": "<f", "U": "<u"}[t] + s) for n, t, s in zip(words["FIELDS"], words["TYPE"], words["SIZE"])]
    return np.frombuffer(body, kinds, int(words["POINTS"][0]))


def points(path):
    table = cloud(path)
    return np.stack([table[a] for a in "xyz"], axis=1)


def clouds(mission):
    return sorted((mission / "individual_clouds").glob("*.pcd"), key=lambda p: [int(n) for n in re.findall(r"\d+", p.name)])


def main(case):
    case.program, case.source = sys.argv[1:3]
    try:
        import rosbags  # noqa: F401
    except ImportError:
        print(f"skipped: {sys.executable} has no rosbags; './bootstrap recordings' installs it")
        sys.exit(77)
    listed = subprocess.run([case.program, "plugins", "describe", "recording"], capture_output=True)
    if listed.returncode:
        print("skipped: the plugin 'python' was not built")
        sys.exit(77)
    unittest.main(argv=sys.argv[:1], verbosity=2)
