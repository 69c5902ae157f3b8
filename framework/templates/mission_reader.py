# SPDX-License-Identifier: BSD-3-Clause
"""Reads TUM trajectories: stamp x y z qx qy qz qw"""
# Replace accepts() and read() by your format; what to keep to: docs/python-plugins.md.
from pathlib import Path

import numpy as np
from cambium import Error, Mission, MissionReader, Param, at_least


class MyMethod(MissionReader):
    every = Param(1, "Of so many poses one becomes a node", at_least(1))

    def accepts(self, path):
        return path.endswith(".tum")

    def read(self, path, context):
        poses, stamps = [], []
        for number, line in enumerate(Path(path).read_text(errors="replace").splitlines(), 1):
            if not line.strip() or line.startswith("#"):
                continue
            try:
                stamp, x, y, z, *q = line.split()
                poses.append(self.pose(np.array([x, y, z], float), np.array(q, float)))
                sec, _, fraction = stamp.partition(".")  # a float would lose nanoseconds
                stamps.append((int(sec), int(f"{fraction:0<9.9}")))
            except (ValueError, OverflowError) as e:
                raise Error(f"expected 'stamp x y z qx qy qz qw', found '{line}' ({e})", f"{path}:{number}")
        if not poses:
            raise Error("has no pose", path)
        return Mission(Path(path).stem, np.array(poses[::self.every]), stamps[::self.every])

    @staticmethod
    def pose(t, q):
        if len(q) != 4 or not np.isfinite([*t, *q]).all() or abs(np.linalg.norm(q) - 1) > 0.01:
            raise ValueError("not a pose")
        x, y, z, w = q / np.linalg.norm(q)
        T = np.eye(4)
        T[:3, :3] = [[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                     [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                     [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]]
        T[:3, 3] = t
        return T
