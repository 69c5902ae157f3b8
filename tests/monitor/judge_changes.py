#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What `cambium changes`, and the inventory, found against the truth of a simulation.

judge_changes.py CHANGES RUN MISSIONS BEFORE AFTER prints figures; the folders are those of `changes
--out`, of the run that it was asked about and of `simulate`; the names those of the two missions.
"""

import csv
import math
import statistics
import sys
from pathlib import Path

NEAR = 0.6  # a reported base and a true one are the same tree [m]


def tum(path):
    """{stamp text: (x, y)}"""
    rows = (line.split() for line in path.read_text().splitlines() if line[:1] not in "#")
    return {r[0]: (float(r[1]), float(r[2])) for r in rows if r}


def map_to_world(run, missions, name):
    """The plane motion that moves the mapped path onto the true one (Umeyama in the plane)."""
    mapped, true = tum(run / f"{name}.tum"), tum(missions / name / "ground_truth.tum")
    pairs = [(complex(*mapped[s]), complex(*true[s])) for s in mapped if s in true]
    a, b = (sum(p[k] for p in pairs) / len(pairs) for k in (0, 1))
    turn = sum((q - b) * (p - a).conjugate() for p, q in pairs)
    turn /= abs(turn)
    return lambda x, y: b + turn * (complex(x, y) - a)


def read(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def nearest(place, trees):
    best = min(trees, key=lambda t: abs(t["place"] - place), default=None)
    return best if best and abs(best["place"] - place) < NEAR else None


def judge(changes, run, missions, before, after):
    to_world = map_to_world(run, missions, before)
    trees = read(missions / "stems.csv")
    for t in trees:
        t["place"] = complex(float(t["x"]), float(t["y"]))
        t["felled"] = t[before] == "1" and t[after] == "0"
    found = read(changes / "stems.csv")
    for f in found:
        f["tree"] = nearest(to_world(float(f["x"]), float(f["y"])), trees)
    rows = {kind: [f for f in found if f["change"] == kind] for kind in ("kept", "gone", "new", "overlooked", "unsure")}
    right = [f for f in rows["gone"] if f["tree"] and f["tree"]["felled"]]
    known = [f for f in found if f["tree"] and f["tree"]["felled"]]  # all that `before` had mapped
    standing = [f for f in found if f["tree"] and not f["tree"]["felled"]]
    wrong = len(rows["gone"]) - len(right) + len(rows["new"])
    column = f"dbh_{after}"
    errors, ratios = [], []
    for f in rows["kept"]:
        if not (f["tree"] and f["growth"]):
            continue
        grown = float(f["tree"].get(column) or f["tree"]["dbh"]) - float(f["tree"]["dbh"])
        errors.append(float(f["growth"]) - grown)
        if f["growth_sigma"]:
            ratios.append(errors[-1] / float(f["growth_sigma"]))
    return {
        "felled, mapped before": len(known),
        "of them found [%]": 100 * len(right) / max(1, len(known)),
        "gone or new": len(rows["gone"]) + len(rows["new"]),
        "of them false [%]": 100 * wrong / max(1, len(rows["gone"]) + len(rows["new"])),
        "standing, called gone or new [%]": 100 * wrong / max(1, len(standing)),
        "overlooked before": len(rows["overlooked"]),
        "unsure": len(rows["unsure"]),
        "trees with growth": len(errors),
        "growth, mean error [mm]": 1000 * statistics.fmean(errors) if errors else math.nan,
        "its standard error [mm]":
            1000 * statistics.stdev(errors) / math.sqrt(len(errors)) if len(errors) > 1 else math.nan,
        "growth, median error [mm]": 1000 * statistics.median(errors) if errors else math.nan,
        "growth, rms error [mm]":
            1000 * math.sqrt(statistics.fmean(e * e for e in errors)) if errors else math.nan,
        "rms of error / sigma": math.sqrt(statistics.fmean(r * r for r in ratios)) if ratios else math.nan,
        "felled trees by diameter": by_diameter(trees, right),
    }


def judge_inventory(run, missions, mission):
    """stems.csv of the exporter `inventory` against the true stems, by the path of one mission."""
    to_world = map_to_world(run, missions, mission)
    trees = read(missions / "stems.csv")
    for t in trees:
        t["place"] = complex(float(t["x"]), float(t["y"]))
    taken, distances, diameters, false = {}, [], [], 0
    for row in read(run / "inventory" / "stems.csv"):
        place = to_world(float(row["x"]), float(row["y"]))
        tree = nearest(place, trees)
        if not tree:
            false += 1
            continue
        taken[id(tree)] = taken.get(id(tree), 0) + 1
        distances.append(abs(tree["place"] - place))
        # Half way between the surveys, where the trees have grown.
        true = [float(tree[c]) for c in tree if c and c.startswith("dbh") and tree[c]]
        diameters.append(float(row["dbh"]) - (min(true) + max(true)) / 2)
    rms = lambda values: math.sqrt(statistics.fmean(v * v for v in values))
    thick = [t for t in trees if float(t["dbh"]) >= 0.25]
    return {
        "trees": len(distances) + false,
        "where none stands": false,
        "counted twice": sum(n - 1 for n in taken.values()),
        "of the stand's, from 0.25 m [%]": 100 * sum(id(t) in taken for t in thick) / max(1, len(thick)),
        "position, median error [m]": statistics.median(distances),
        "dbh, rms error [m]": rms(diameters),
        "dbh, mean error [m]": statistics.fmean(diameters),
    }


def by_diameter(trees, right):
    """Of all felled trees of the stand, seen or not: found / felled, for diameters from .. m."""
    hit = {id(f["tree"]) for f in right}
    out = []
    for low, high in ((0, 0.1), (0.1, 0.15), (0.15, 0.2), (0.2, 0.25), (0.25, 9)):
        felled = [t for t in trees if t["felled"] and low <= float(t["dbh"]) < high]
        out.append(f"{low}: {sum(id(t) in hit for t in felled)}/{len(felled)}")
    return ", ".join(out)


if __name__ == "__main__":
    changes, run, missions = map(Path, sys.argv[1:4])
    figures = judge(changes, run, missions, *sys.argv[4:6])
    if (run / "inventory" / "stems.csv").exists():
        figures |= {f"inventory: {k}": v for k, v in judge_inventory(run, missions, sys.argv[4]).items()}
    for name, value in figures.items():
        print(f"{name:42} {value:.4g}" if isinstance(value, float) else f"{name:42} {value}")
