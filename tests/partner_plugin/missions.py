# SPDX-License-Identifier: BSD-3-Clause
"""Two small mission folders along the same path, seen by two robots with other headings."""

import math
import random
import struct

STEP = 8.0  # between nodes [m]


def poles(seed=1):
    """A street with poles at random places, denser along its way: (x, y) [m]."""
    rng = random.Random(seed)
    return [(rng.uniform(-40, 120), rng.choice((-1, 1)) * rng.uniform(2, 40)) for _ in range(250)]


def scan(world, x, y, yaw, rng):
    """Points of the poles within 40 m, in the base frame [m]."""
    c, s = math.cos(yaw), math.sin(yaw)
    points = []
    for px, py in world:
        dx, dy = px - x, py - y
        if math.hypot(dx, dy) > 40:
            continue
        for _ in range(20):
            ex, ey = dx + rng.gauss(0, 0.05), dy + rng.gauss(0, 0.05)
            points.append((c * ex + s * ey, -s * ex + c * ey, rng.uniform(0, 4)))
    return points


def write_pcd(path, points):
    header = ("VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n"
              f"WIDTH {len(points)}\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\n"
              f"POINTS {len(points)}\nDATA binary\n")
    body = b"".join(struct.pack("<3f", *p) for p in points)
    path.write_bytes(header.encode() + body)


def write_mission(folder, nodes, heading, seed):
    """Node i stands at x = i * STEP; the mission's frame has its first node as origin."""
    rng = random.Random(seed)
    (folder / "individual_clouds").mkdir(parents=True)
    world, lines = poles(), []
    for i in range(nodes):
        x, y = i * STEP + rng.uniform(-0.5, 0.5), rng.uniform(-0.5, 0.5)
        write_pcd(folder / "individual_clouds" / f"cloud_{i}_000000000.pcd",
                  scan(world, x, y, heading, rng))
        c, s = math.cos(-heading), math.sin(-heading)
        pose = f"{c * i * STEP} {s * i * STEP} 0 0 0 0 1"
        lines.append(f"VERTEX_SE3:QUAT_TIME {i} {pose} {i} 0")
    information = " ".join("400" if i in (0, 6, 11, 15, 18, 20) else "0" for i in range(21))
    for i in range(nodes - 1):
        c, s = math.cos(-heading), math.sin(-heading)
        lines.append(f"EDGE_SE3:QUAT {i} {i + 1} {c * STEP} {s * STEP} 0 0 0 0 1 {information}")
    (folder / "slam_pose_graph.g2o").write_text("\n".join(lines) + "\n")
