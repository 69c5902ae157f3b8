# SPDX-License-Identifier: BSD-3-Clause
"""A run folder as large as a season's: what `cambium run` would have left, made up."""

import json
import math
import random
from pathlib import Path

NAMES = ("backpack", "drone", "a<b>&'c'")  # the last one must not break the page


def pose(mission, i, drift=0.0):
    turn = 2 * math.pi * i / 400
    return 40 * mission + (60 + 30 * math.sin(turn / 3)) * math.cos(turn) + drift * i, \
        60 * math.sin(turn) + 0.02 * i, 3 * math.sin(turn / 2)


def vertex(node, xyz, stamp):
    return "VERTEX_SE3:QUAT_TIME %d %.4f %.4f %.4f 0 0 0 1 %d 0\n" % (node, *xyz, stamp)


def write(folder, nodes=1000, candidates=20000):
    """Three missions of `nodes` nodes with so many candidates. Returns the run folder."""
    folder, run = Path(folder), Path(folder, "run")
    run.mkdir()
    fused = ""
    for m, name in enumerate(NAMES):
        own = "".join(vertex(i, pose(m, i, 0.001), 1000 + i) for i in range(nodes))
        Path(folder, f"{name}.g2o").write_text(own)
        fused += "".join(vertex(i + 10000 * m, pose(m, i), 1000 + i) for i in range(nodes))
    (run / "fused.g2o").write_text(fused)
    rows = [row(random.Random(k), k, nodes) for k in range(candidates)]
    (run / "ledger.jsonl").write_text("".join(json.dumps(r) + "\n" for r in rows))
    (run / "report.json").write_text(json.dumps(report()))
    (run / "resolved.yaml").write_text("version: 1\nmissions: [%s]\nsteps: []\n" % ", ".join(
        json.dumps(str(Path(folder, f"{name}.g2o").resolve())) for name in NAMES))
    return run


def row(r, k, nodes):
    (a, i), (b, j) = sorted([(r.randrange(3), r.randrange(nodes)) for _ in range(2)])
    state = ("accepted", "rejected", "rejected")[k % 3]
    met = k % 3 < 2
    p, q = pose(a, i), pose(b, j)
    out = {"tail": {"mission": NAMES[a], "id": i, "fused_id": 0},
           "head": {"mission": NAMES[b], "id": j, "fused_id": 0}, "state": state,
           "proposed_by": ("scan_context", "proximity")[k % 2], "registered_by": "gicp",
           "decided_by": "pairwise_consistency" if met else "gicp",
           "reason": f"consistent with {r.randrange(900)} of {r.randrange(900)} other loops within {NAMES[a]}" if met
           else f"overlap {r.random():.3f} is below min_overlap 0.4",
           "scores": {name: r.random() for name in
                      ("scan_context", "overlap", "inliers", "rmse", "seen_through", "sigma_x",
                       "sigma_y", "sigma_z", "sigma_roll", "sigma_pitch", "sigma_yaw")}}
    if met:
        off = r.gauss(0, 0.05 if state == "accepted" else 3)
        out["T_tail_head"] = [q[0] - p[0] + off, q[1] - p[1], q[2] - p[2], 0, 0, 0, 1]
    if state == "accepted":
        out |= {"weight": r.random(), "residual": {"translation": abs(off), "rotation": 0}}
    return out


def report():
    step = {"label": "", "seconds": 1.5, "work_seconds": 3, "items": 4, "cached_items": 0, "cached": False,
            "summary": "done", "figures": {}, "files": [], "key": {}}
    steps = [step | {"verb": "evaluate", "plugin": "ate", "label": label} for label in ("before", "after")]
    metrics = [{"name": f"{label}.ate.rmse", "unit": "m", "value": value, "better": "lower"}
               for label, value in (("before", 4.2), ("after", 0.1))]
    return {"cambium": "0.1.0", "missions": [], "islands": [{"missions": list(NAMES), "georeference": None}],
            "steps": steps, "metrics": metrics, "warnings": ["mission <i>backpack</i> is tired"]}
