# SPDX-License-Identifier: BSD-3-Clause
"""Every exporter on a full disk, and within the memory that it may take.

test_exports.py CAMBIUM: a file that could not be written is named, exit code 4, and what stands under a final name is whole:
the bytes of the same export on a disk with room.
"""

import resource
import signal
import subprocess
import sys
import tempfile
from pathlib import Path

SPEC = """
version: 1
seed: 5
stand: {size: [60, 40], density: 300}
sensor: {beams: 16, columns: 180, max_range: 20, labels: true}
trees: {enabled: true}
path: {kind: line, size: [30, 0], spacing: 0.5}
missions:
  - {name: spring, gnss: {enabled: true, sigma: 0.5}}
  - {name: autumn, path: {offset: 2}, gnss: {enabled: true, sigma: 0.5}}
"""
LIMIT = 4000  # [bytes] more than what a run writes before its exports, less than any export
program = sys.argv[1]


def exporters():
    """Those of this build; `python` is one by the user's script only."""
    listed = subprocess.run([program, "plugins", "list"], capture_output=True, text=True, check=True).stdout
    names, kind = [], None
    for line in listed.splitlines():
        if line and not line[0].isspace():
            kind = line.split()[0].rstrip(":")
        elif line.split() and kind == "map_exporter":
            names.append(line.split()[0])
    return [n for n in names if n != "python"]


def full_disk():
    """No file may grow beyond LIMIT: writing fails as on a full disk."""
    signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (LIMIT, LIMIT))


def run(folder, exporter, out, before=None):
    pipeline = folder / f"{exporter}.yaml"
    pipeline.write_text(f"version: 1\nsteps:\n  - georeference: similarity_4dof\n  - export: {exporter}\n")
    missions = [str(folder / "missions" / m) for m in ("spring", "autumn")]
    return subprocess.run([program, "run", str(pipeline), *missions, "--out", str(out), "--cache", "none"],
                          capture_output=True, text=True, preexec_fn=before)


def files_in(folder):
    return {str(p.relative_to(folder)): p.read_bytes() for p in folder.rglob("*") if p.is_file()}


def a_full_disk_leaves_nothing_half_written(folder, exporter):
    done = run(folder, exporter, folder / f"{exporter}_good")
    if "need the Python package" in done.stderr:  # tests/recordings brings it, and tries the same there
        print(f"{exporter}: skipped: {done.stderr.strip()}")
        return
    assert done.returncode == 0, f"{exporter}: {done.stderr}"
    good = files_in(folder / f"{exporter}_good" / exporter)
    assert any(len(content) > LIMIT for content in good.values()), f"{exporter}: {sorted(good)}"
    done = run(folder, exporter, folder / f"{exporter}_full", full_disk)
    assert done.returncode == 4, f"{exporter}: exit code {done.returncode}\n{done.stderr}"
    named = [name for name in good if Path(name).name in done.stderr]
    assert named or "is the disk full?" in done.stderr, f"{exporter}: no file is named in: {done.stderr}"
    left = files_in(folder / f"{exporter}_full" / exporter)
    for name, content in left.items():
        assert content == good.get(name), f"{exporter}: {name} is not what it should be"
    assert len(left) < len(good), f"{exporter}: {sorted(left)}"
    print(f"{exporter}: {len(left)} of {len(good)} files, {done.stderr.splitlines()[-1][-120:]}")


with tempfile.TemporaryDirectory() as name:
    work = Path(name)
    (work / "spec.yaml").write_text(SPEC)
    subprocess.run([program, "simulate", str(work / "spec.yaml"), str(work / "missions")], check=True, capture_output=True)
    found = exporters()
    assert {"cloud", "las", "g2o", "tum", "kitti", "geojson", "inventory"} <= set(found), found
    for one in found:
        a_full_disk_leaves_nothing_half_written(work, one)
