# SPDX-License-Identifier: BSD-3-Clause
"""One CSV file of poses a mission"""
# Replace write() by your method; what to keep to: docs/python-plugins.md.
from pathlib import Path

from cambium import MapExporter, Param, between, write_file


class MyMethod(MapExporter):
    decimals = Param(4, "Behind the point", between(0, 15))

    def write(self, atlas, folder, context):
        files = []
        for mission in atlas.missions:
            context.check_cancelled()
            rows = ["sec,nsec,x,y,z"]
            for (sec, nsec), T in zip(mission.stamps, mission.T_map_node):
                rows.append(f"{sec},{nsec}," + ",".join(f"{v:.{self.decimals}f}" for v in T[:3, 3]))
            files.append(Path(folder) / f"{mission.name}.csv")
            write_file(files[-1], "\n".join(rows) + "\n")  # whole or not at all
        return files
