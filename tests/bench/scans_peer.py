# SPDX-License-Identifier: BSD-3-Clause
"""The peers of bench_scans: scans_peer.py NEWER_COLLEGE MULRAN. Needs numpy, small_gicp and
kiss_matcher. Prints rows in the form of bench_scans; times are processor times of one thread."""

import sys
import time
from pathlib import Path

import kiss_matcher
import numpy as np
import small_gicp


def read_pcd(path):
    """x y z of a binary PCD, rows without NaN."""
    data = path.read_bytes()
    head, _, body = data.partition(b"DATA binary\n")
    keys = dict(line.split(" ", 1) for line in head.decode().splitlines() if " " in line)
    code = {"F4": "<f4", "F8": "<f8", "U1": "u1", "U2": "<u2", "U4": "<u4", "I4": "<i4"}
    columns = zip(keys["FIELDS"].split(), keys["TYPE"].split(), keys["SIZE"].split())
    kind = np.dtype([(name, code[t + size]) for name, t, size in columns])
    rows = np.frombuffer(body, kind, int(keys["POINTS"]))
    points = np.stack([rows["x"], rows["y"], rows["z"]], axis=1).astype(float)
    return points[np.isfinite(points).all(axis=1)]


def pose(t, q):
    x, y, z, w = q
    T = np.eye(4)
    T[:3, :3] = [[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                 [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                 [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]]
    T[:3, 3] = t
    return T


def college(folder):
    rows = np.loadtxt(folder / "ground_truth.tum")
    clouds = [read_pcd(p) for p in sorted((folder / "individual_clouds").iterdir())]
    return clouds, [pose(r[1:4], r[4:8]) for r in rows]


def mulran(folder, count=21):
    rows = np.loadtxt(folder / "optimized_poses.txt")[:count].reshape(-1, 3, 4)
    clouds = [read_pcd(folder / "Scans" / f"{i:06d}.pcd") for i in range(count)]
    return clouds, [np.vstack([r, [0, 0, 0, 1]]) for r in rows]


def error(T):
    return np.linalg.norm(T[:3, 3]), np.degrees(np.arccos(np.clip((np.trace(T[:3, :3]) - 1) / 2, -1, 1)))


def timed(f):
    begin = time.process_time()
    return f(), 1e3 * (time.process_time() - begin)


def prepare(cloud, voxel=0.25):
    return timed(lambda: small_gicp.preprocess_points(cloud, downsampling_resolution=voxel, num_threads=1))


def gicp(target, source, guess):
    return timed(lambda: small_gicp.align(target[0], source[0], target[1], guess,
                                          max_correspondence_distance=1.0, num_threads=1,
                                          max_iterations=30).T_target_source)


def start():
    """The displacement of bench_scans: exp of (0.3, -0.3, 0.1; 0.01, -0.01, 0.05), by its series."""
    xi = np.zeros((4, 4))
    xi[:3] = [[0, -0.05, -0.01, 0.3], [0.05, 0, -0.01, -0.3], [0.01, 0.01, 0, 0.1]]
    T, term = np.eye(4), np.eye(4)
    for k in range(1, 12):
        term = term @ xi / k
        T = T + term
    return T


def consecutive(name, clouds, poses, courtyard):
    prepared, times = zip(*(prepare(c) for c in clouds))
    chains, aligned, errors = {}, [], []
    for step in (1, 2):
        chains[step] = []
        for i in range(len(clouds) - step):
            truth = np.linalg.inv(poses[i]) @ poses[i + step]
            T, ms = gicp(prepared[i], prepared[i + step], truth @ start() if courtyard else np.eye(4))
            chains[step].append(T)
            if step == 1:
                aligned.append(ms)
                errors.append(error(np.linalg.inv(truth) @ T))
    gaps = [error(np.linalg.inv(T) @ chains[1][i] @ chains[1][i + 1]) for i, T in enumerate(chains[2])]
    once, pair = np.median(times), np.median(aligned)
    (t, r), (gap_t, gap_r) = np.median(errors, axis=0), np.median(gaps, axis=0)
    print(f"| {name:9} | small_gicp | {once:5.1f} | {pair:5.1f} | {2 * once + pair:5.1f} | {t:.3f} m {r:.2f} deg "
          f"| {gap_t:.4f} m {gap_r:.3f} deg |", flush=True)


def without_a_guess(a, b):
    limits, rows = [5, 10, 15, 20, 25, 30], []
    prepared = {id(c): prepare(c) for c in a[0] + b[0]}
    matcher = kiss_matcher.KISSMatcher(0.5)
    for target, T_a in zip(*a):
        for source, T_b in zip(*b):
            truth = np.linalg.inv(T_a) @ T_b
            baseline = np.linalg.norm(truth[:3, 3])
            if baseline >= 30:
                continue
            found, ms = timed(lambda: matcher.estimate(list(source.astype(np.float32)), list(target.astype(np.float32))))
            T = np.eye(4)
            T[:3, :3], T[:3, 3] = found.rotation, found.translation
            (pt, ps) = prepared[id(target)], prepared[id(source)]
            refined, more = gicp(pt[0], ps[0], T)
            good = [error(np.linalg.inv(truth) @ X) for X in (T, refined)]
            rows.append([np.searchsorted(limits, baseline, side="right"), ms, more + pt[1] + ps[1]] +
                        [t < 0.5 and r < 5 for t, r in good])
    rows = np.array(rows, dtype=float)
    print("| pairs | n | KISS-Matcher correct % | + small_gicp correct % | ms | + ms |\n|---|---|---|---|---|---|")
    for k, limit in enumerate(limits):
        r = rows[rows[:, 0] == k]
        print(f"| {limit - 5}-{limit} m | {len(r)} | {100 * r[:, 3].mean():.1f} | {100 * r[:, 4].mean():.1f} "
              f"| {np.median(r[:, 1]):.0f} | {np.median(r[:, 2]):.0f} |", flush=True)


def near(target, T, source, distance=0.2):
    """The share of the source's points that have one of the target's within `distance` [m]."""
    points = source[0].points()[:, :3] @ T[:3, :3].T + T[:3, 3]
    return np.mean(np.sqrt(target[1].batch_nearest_neighbor_search(points)[1]) < distance)


def from_the_truth(a, b):
    """What the truth allows for: started at it, how many registrations stay with it, and how well the
    clouds lie on each other at the truth and where the registration ends."""
    limits, rows = [5, 10, 15, 20, 25, 30], []
    targets, sources = ([prepare(c)[0] for c in clouds] for clouds in (a[0], b[0]))
    for target, T_a in zip(targets, a[1]):
        for source, T_b in zip(sources, b[1]):
            truth = np.linalg.inv(T_a) @ T_b
            baseline = np.linalg.norm(truth[:3, 3])
            if baseline < 30:
                T = gicp(target, source, truth)[0]
                t, r = error(np.linalg.inv(truth) @ T)
                rows.append([np.searchsorted(limits, baseline, side="right"), t < 0.5 and r < 5, t, r,
                             near(target, truth, source), near(target, T, source)])
    rows = np.array(rows, dtype=float)
    print("| pairs | n | small_gicp from the truth: correct % | moved by | points within 0.2 m: at the truth % "
          "| at the result % |\n|---|---|---|---|---|---|")
    for k, limit in enumerate(limits):
        r = rows[rows[:, 0] == k]
        print(f"| {limit - 5}-{limit} m | {len(r)} | {100 * r[:, 1].mean():.1f} | {np.median(r[:, 2]):.2f} m "
              f"{np.median(r[:, 3]):.1f} deg | {100 * r[:, 4].mean():.0f} | {100 * r[:, 5].mean():.0f} |", flush=True)


def main():
    folder, cars = Path(sys.argv[1]), Path(sys.argv[2])
    a, b = college(folder / "mission_a"), college(folder / "mission_b")
    consecutive("courtyard", *a, True)
    for name in ("KAIST03", "Seosan01"):
        consecutive(name, *mulran(cars / name), False)
    without_a_guess(a, b)
    from_the_truth(a, b)


if __name__ == "__main__":
    main()
