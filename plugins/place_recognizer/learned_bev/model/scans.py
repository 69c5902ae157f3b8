# SPDX-License-Identifier: BSD-3-Clause
"""Simulated missions as polar density images, the way learned_bev makes them."""

import subprocess
from pathlib import Path

import numpy as np
from network import RINGS, SECTORS

MAX_RANGE, LOWEST, HIGHEST = 40.0, -1.0, 6.0  # the defaults of learned_bev
STAND = """version: 1
seed: {seed}
stand: {{size: [120, 90], density: {density}}}
terrain: {{max_slope: {slope}}}
sensor: {{beams: {beams}, columns: 512, max_range: 45}}
path: {{kind: loop, size: [64, 40], spacing: 2}}
missions:
  - {{name: a}}
  - {{name: b, path: {{offset: {beside}, reversed: true}}}}
  - {{name: c, path: {{offset: -{beside}}}}}
"""


def simulate(program, folder, seed):
    """One stand, others in density, slope, sensor and distance of the paths by its seed."""
    rng = np.random.default_rng(seed)
    spec = folder / f"stand_{seed}.yaml"
    spec.write_text(STAND.format(seed=seed, density=int(rng.integers(400, 1100)),
                                 slope=int(rng.integers(4, 16)), beams=int(rng.choice([16, 32, 64])),
                                 beside=float(rng.choice([1, 2, 3]))))
    subprocess.run([program, "simulate", spec, folder / f"stand_{seed}"], check=True,
                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    return folder / f"stand_{seed}"


def read_pcd(path):
    """x, y, z of a binary PCD file whose fields are float32."""
    data = path.read_bytes()
    end = data.index(b"DATA binary\n") + len(b"DATA binary\n")
    header = dict(line.split(" ", 1) for line in data[:end].decode().splitlines()
                  if not line.startswith("#"))
    fields = header["FIELDS"].split()
    return np.frombuffer(data, np.float32, offset=end).reshape(-1, len(fields))[:, :3]


def rotation(q):
    x, y, z, w = q
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                     [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                     [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])


def polar_image(points):
    """log(1 + count) of levelled points in rings and sectors, over the largest of them."""
    ranges = np.hypot(points[:, 0], points[:, 1])
    turns = np.arctan2(points[:, 1], points[:, 0]) / (2 * np.pi) % 1.0
    kept = (ranges < MAX_RANGE) & (points[:, 2] >= LOWEST) & (points[:, 2] <= HIGHEST)
    ring = (ranges[kept] * (RINGS / MAX_RANGE)).astype(int)
    sector = np.minimum((turns[kept] * SECTORS).astype(int), SECTORS - 1)
    image = np.log1p(np.bincount(ring * SECTORS + sector, minlength=RINGS * SECTORS))
    return (image / max(image.max(), 1e-9)).reshape(RINGS, SECTORS).astype(np.float32)


def images(stand, headings, rng):
    """[node] of (positions, images at random headings) of all missions of a stand."""
    positions, out = [], []
    for truth in sorted(Path(stand).glob("*/ground_truth.tum")):
        clouds = sorted((truth.parent / "individual_clouds").iterdir())
        for row, cloud in zip(np.loadtxt(truth), clouds):
            points = read_pcd(cloud) @ rotation(row[4:8]).T.astype(np.float32)
            seen = []
            for angle in rng.uniform(0, 2 * np.pi, headings):
                c, s = np.cos(angle), np.sin(angle)
                seen.append(polar_image(points @ np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]], np.float32)))
            positions.append(row[1:3])
            out.append(seen)
    return np.array(positions), np.array(out)
