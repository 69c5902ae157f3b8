# SPDX-License-Identifier: BSD-3-Clause
"""Two surveys of a simulated stand, fused, queried by coordinates and compared with the truth.

Arguments: the program, the source tree.
"""

import csv
import json
import resource
import signal
import subprocess
import sys
import tempfile
from pathlib import Path

from judge_changes import judge, judge_inventory

program, root = sys.argv[1], Path(sys.argv[2])


def run(*arguments, code=0):
    """What the command printed; its messages where it is meant to fail."""
    done = subprocess.run([program, *map(str, arguments), *([] if arguments[0] == "simulate" else ["--cache", "none"])],
                          capture_output=True, text=True)
    assert done.returncode == code, f"{arguments}: exit code {done.returncode}, expected {code}\n{done.stderr}"
    return done.stdout if code == 0 else done.stderr


def contains(text, part):
    assert part in text, f"expected '{part}' in:\n{text}"


def make_map(folder):
    steps = (root / "pipelines/fuse_trees.yaml").read_text()
    (folder / "map.yaml").write_text(steps + "  - georeference: similarity_4dof\n  - export: inventory\n")
    run("simulate", root / "tests/specs/monitored.yaml", folder / "missions")
    missions = [folder / "missions" / m for m in ("spring", "autumn")]
    run("run", folder / "map.yaml", *missions, "--out", folder / "map")
    report = json.loads((folder / "map/report.json").read_text())
    assert len(report["islands"]) == 1, report["islands"]


def changes_are_those_of_the_truth(folder):
    text = run("changes", f"{folder}/map:spring", f"{folder}/map:autumn", "--out", folder / "changes")
    contains(text, "gone")
    found = judge(folder / "changes", folder / "map", folder / "missions", "spring", "autumn")
    print(json.dumps(found, indent=1))
    assert found["felled, mapped before"] >= 100, found
    assert found["of them found [%]"] >= 95, found
    assert found["of them false [%]"] <= 2, found
    assert abs(found["growth, mean error [mm]"]) <= 2, found
    assert found["trees with growth"] >= 200 and found["its standard error [mm]"] < 1, found
    for name in ("stems", "cells"):
        features = json.loads((folder / f"changes/{name}.geojson").read_text())["features"]
        with open(folder / f"changes/{name}.csv", newline="") as file:
            assert len(features) == len(list(csv.DictReader(file))) > 0
    summary = json.loads((folder / "changes/changes.json").read_text())
    assert summary["ground"]["cells"] > 100 and abs(summary["canopy"]["median"]) < 0.3, summary


def inventory_is_that_of_the_truth(folder):
    found = judge_inventory(folder / "map", folder / "missions", "spring")
    print(json.dumps(found, indent=1))
    assert found["trees"] > 350 and found["counted twice"] == 0, found
    assert found["where none stands"] <= 0.01 * found["trees"], found
    assert found["of the stand's, from 0.25 m [%]"] > 75, found
    assert found["position, median error [m]"] < 0.1, found
    assert found["dbh, rms error [m]"] < 0.02 and abs(found["dbh, mean error [m]"]) < 0.004, found
    with open(folder / "map/inventory/stems.csv", newline="") as file:
        rows = list(csv.DictReader(line for line in file if line[0] != "#"))
    features = json.loads((folder / "map/inventory/stems.geojson").read_text())["features"]
    assert len(features) == len(rows) == found["trees"]


def queries_answer(folder):
    with open(folder / "map/inventory/stems.csv", newline="") as file:
        tree = next(r for r in csv.DictReader(line for line in file if line[0] != "#")
                    if len(r["missions"].split(";")) == 2)
    at = ("--at", f"{tree['latitude']},{tree['longitude']}", "--radius", "5m")
    answer = json.loads(run("query", folder / "map", *at, "--json", "--out", folder / "place"))
    assert {m["name"] for m in answer["missions"]} == {"spring", "autumn"}, answer["missions"]
    assert any(abs(s["latitude"] - float(tree["latitude"])) < 1e-7 for s in answer["stems"])
    assert all(Path(f).exists() for f in answer["files"]) and len(answer["files"]) == 2, answer["files"]
    assert json.loads((folder / "place/place.json").read_text()) == answer
    # The same place in metres holds the same trees.
    plane = ("--at", f"{tree['easting']},{tree['northing']}", "--radius", "5m", "--epsg", "32635")
    again = json.loads(run("query", folder / "map", *plane, "--json"))
    assert len(again["stems"]) == len(answer["stems"]) and len(again["nodes"]) == len(answer["nodes"])
    only = json.loads(run("query", f"{folder}/map:autumn", *at, "--json"))
    assert {m["name"] for m in only["missions"]} == {"autumn"}
    contains(run("query", folder / "map", *at), "stems")


def mistakes_say_what_to_do(folder):
    at = ("--at", "61.2,25.1", "--radius", "5m")
    contains(run("query", folder / "map", "--at", "61.9,25.1", "--radius", "5m", code=1), "the nearest node is")
    contains(run("query", folder / "missions/spring", *at, code=2), "is not georeferenced")
    contains(run("query", f"{folder}/map:sprong", *at, code=2), "did you mean 'spring'?")
    contains(run("query", folder / "nowhere", *at, code=2), "does not exist")
    contains(run("query", folder / "map", *at, "--epsg", "999999", code=2), "PROJ knows no")
    contains(run("query", folder / "map", "--at", "61.2", "--radius", "5m", code=2), "expected LAT,LON")
    contains(run("query", folder / "map", *at, "--out", folder / "missions", code=2), "not the answer to a query")
    contains(run("changes", folder / "missions/spring", folder / "missions/autumn", "--out", folder / "c", code=2),
             "RUN:MISSION")


small = 1 << 18  # [bytes] more than the answer itself takes, less than the cloud


def small_disk():
    """No file may become larger than this; writing fails as on a full disk."""
    signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (small, small))


def a_full_disk_leaves_no_half_files(folder):
    arguments = [program, "query", folder / "map", "--at", "61.2,25.1", "--radius", "20m", "--cache", "none",
                 "--out", folder / "full", "--export", "las"]
    done = subprocess.run([*map(str, arguments)], capture_output=True, text=True, preexec_fn=small_disk)
    assert done.returncode == 4, done
    contains(done.stderr, "map.las")
    assert not list((folder / "full/las").iterdir()), list((folder / "full/las").iterdir())
    subprocess.run([*map(str, arguments)], check=True, capture_output=True)
    assert (folder / "full/las/map.las").stat().st_size > small


with tempfile.TemporaryDirectory() as name:
    work = Path(name)
    make_map(work)
    changes_are_those_of_the_truth(work)
    inventory_is_that_of_the_truth(work)
    queries_answer(work)
    mistakes_say_what_to_do(work)
    a_full_disk_leaves_no_half_files(work)
