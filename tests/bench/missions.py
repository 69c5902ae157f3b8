# SPDX-License-Identifier: BSD-3-Clause
"""How fusing grows with the number of missions.

python3 tests/bench/missions.py build/bin/cambium                  # 10, 30 and 100 missions of 500 nodes
python3 tests/bench/missions.py build/bin/cambium --counts 2 9 --nodes 120 --spacing 3 --check    # the test

Missions are loops beside each other, in rows; neighbours overlap by 8 m. They bring home
tree tables and GNSS fixes of 3 m. One row a fleet: pairs of missions, how many were compared,
candidates, loops, processor time of each part, peak of resident memory, and whether the map is right.
"""
import argparse
import json
import math
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

PIPELINE = """version: 1
steps:
  - recognize: tree_match
    pairs: between_missions
    max_distance: 30
  - register: tree_align
  - verify: pairwise_consistency
  - optimize: sparse_lm
    attitude_sigma: 0.1
    params: {loss: cauchy}
  - recognize: proximity
    pairs: between_missions
    max_distance: 30
    params: {radius: 12.0, candidates: 1}
  - register: tree_align
  - verify: pairwise_consistency
  - optimize: sparse_lm
    attitude_sigma: 0.1
    params: {loss: cauchy}
  - evaluate: ate
  - evaluate: loops
"""
OVERLAP = 8.0  # of the loops of neighbours [m]


def columns_of(count):
    """The loops are twice as wide as deep, so this makes the fleet about square."""
    return math.ceil(math.sqrt(count / 2))


def neighbours(count):
    """Pairs of missions whose loops touch, also by a corner."""
    place = [divmod(i, columns_of(count)) for i in range(count)]
    return sum(abs(a[0] - b[0]) <= 1 and abs(a[1] - b[1]) <= 1
               for i, a in enumerate(place) for b in place[:i])


def specification(count, nodes, spacing, gnss):
    """A stand with `count` loops of `nodes` nodes, twice as long as wide."""
    # Ramanujan's perimeter of the ellipse with half axes 2b and b is 9.688 b.
    depth = 2 * nodes * spacing / 9.688
    width = 2 * depth
    columns = columns_of(count)
    rows = math.ceil(count / columns)
    dx, dy = width - OVERLAP, depth - OVERLAP
    lines = ["version: 1", "seed: 7",
             f"stand: {{size: [{columns * dx + 80:.0f}, {rows * dy + 80:.0f}], density: 700}}",
             "sensor: {clouds: false}", "trees: {enabled: true}",
             f"gnss: {{enabled: {'true' if gnss else 'false'}, rate: 0.2, sigma: 3}}",
             # loops.csv is not needed, and pairs of all nodes would take longer than the fusion
             "loops: {max_baseline: 1}",
             "missions:"]
    for i in range(count):
        x = (i % columns - (columns - 1) / 2) * dx
        y = (i // columns - (rows - 1) / 2) * dy
        lines.append(f"  - {{name: mission_{i:03d}, platform: {i % 5}, path: {{kind: loop, spacing: {spacing:g}, "
                     f"center: [{x:.1f}, {y:.1f}], size: [{width:.1f}, {depth:.1f}]}}}}")
    return "\n".join(lines) + "\n"


def run(command):
    """Runs it; returns processor seconds and the peak of resident memory [MB]."""
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    if status != 0:
        sys.exit(f"failed with {os.waitstatus_to_exitcode(status)}: {' '.join(map(str, command))}")
    return usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024


def fuse(cambium, folder, count, options):
    """Simulates and fuses one fleet; returns what the row says."""
    name = f"{count}_without_gnss" if options.without_gnss else str(count)
    spec, missions, out = folder / f"{name}.yaml", folder / f"missions_{name}", folder / f"map_{name}"
    spec.write_text(specification(count, options.nodes, options.spacing, not options.without_gnss))
    (folder / "pipeline.yaml").write_text(PIPELINE)
    if not (missions / "spec.yaml").exists():
        run([cambium, "simulate", spec, missions, "--quiet"])
    shutil.rmtree(out, ignore_errors=True)
    seconds, peak = run([cambium, "run", folder / "pipeline.yaml", f"{missions}/mission_*", "--out", out,
                         "--cache", "none", "--threads", str(options.threads), "--memory", options.memory, "--quiet"])
    report = json.loads((out / "report.json").read_text())
    metrics = {m["name"]: m["value"] for m in report["metrics"]}
    row = {"missions": count, "seconds": seconds, "peak": peak, "islands": len(report["islands"]),
           "ate": metrics["ate.rmse"], "accepted": metrics["loops.accepted"],
           "wrong": metrics["loops.wrong"], "parts": {}}
    for step in report["steps"]:
        row["parts"][step["verb"]] = row["parts"].get(step["verb"], 0) + step["seconds"]
    first = next(s for s in report["steps"] if s["verb"] == "recognize")["figures"]
    row["pairs"], row["compared"] = first["mission_pairs"], first["mission_pairs.compared"]
    row["apart"] = first["mission_pairs.apart_by_gnss"]
    return row


def check(row, memory_mb, without_gnss):
    """What the test asks of every fleet."""
    count = row["missions"]
    assert row["pairs"] == count * (count - 1) / 2, row
    assert row["compared"] + row["apart"] == row["pairs"], row
    assert row["compared"] == (row["pairs"] if without_gnss else neighbours(count)), (neighbours(count), row)
    assert row["islands"] == 1 and row["wrong"] <= 0.01 * row["accepted"] and row["ate"] < 1, row
    assert row["peak"] < memory_mb, row


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("cambium", type=pathlib.Path)
    parser.add_argument("--counts", type=int, nargs="+", default=[10, 30, 100])
    parser.add_argument("--nodes", type=int, default=500)
    parser.add_argument("--spacing", type=float, default=1.0, help="between nodes [m]")
    parser.add_argument("--memory", default="4G")
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--without-gnss", action="store_true", help="no fixes: nothing says which pairs can meet")
    parser.add_argument("--folder", type=pathlib.Path, help="keeps the missions here for the next time")
    parser.add_argument("--check", action="store_true", help="fail when a row is not as it should be")
    options = parser.parse_args()
    folder = options.folder or pathlib.Path(tempfile.mkdtemp(prefix="cambium-missions-"))
    folder.mkdir(parents=True, exist_ok=True)
    print("| missions | pairs | compared | recognise [s] | register [s] | verify [s] | optimise [s] "
          "| all, processor [s] | s a pair compared | peak [MB] | islands | loops (wrong) | ATE [m] |")
    print("|---" * 13 + "|")
    for count in options.counts:
        row = fuse(options.cambium, folder, count, options)
        parts = [row["parts"][verb] for verb in ("recognize", "register", "verify", "optimize")]
        print(f"| {count} | {row['pairs']:.0f} | {row['compared']:.0f} | "
              + " | ".join(f"{p:.1f}" for p in parts)
              + f" | {row['seconds']:.1f} | {row['seconds'] / row['compared']:.2f} | {row['peak']:.0f} "
              f"| {row['islands']} | {row['accepted']:.0f} ({row['wrong']:.0f}) | {row['ate']:.3f} |",
              flush=True)
        if options.check:
            check(row, 512, options.without_gnss)
    if not options.folder:
        shutil.rmtree(folder)


if __name__ == "__main__":
    main()
