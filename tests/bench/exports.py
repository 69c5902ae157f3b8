# SPDX-License-Identifier: BSD-3-Clause
"""The memory that exports take of a map larger than --memory.

python3 tests/bench/exports.py build/bin/cambium
python3 tests/bench/exports.py build/bin/cambium --columns 450 --memory 200 --check   # fails when one takes more

A simulated robot walks to and fro through a stand; its clouds together are larger than the budget. One row an exporter: peak of
resident memory, processor time, size of what it wrote.
"""
import argparse
import os
import subprocess
import sys
import tempfile
from pathlib import Path

SPEC = """
version: 1
seed: 7
stand: {{size: [160, 120], density: 400}}
sensor: {{beams: 64, columns: {columns}, max_range: 40}}
path: {{kind: lawn_mower, size: [110, 80], lanes: 5, spacing: 2}}
missions:
  - {{name: robot, gnss: {{enabled: true, sigma: 0.5}}}}
"""
EXPORTS = {
    "cloud": "{voxel_size: 0.05}",
    "las": "{voxel_size: 0.05}",
    "projected": "{voxel_size: 0.05}",
    "web_view": "{}",
    "geopackage": "{}",
    "g2o": "{}",
}


def size_of(folder):
    return sum(p.stat().st_size for p in folder.rglob("*") if p.is_file()) / 1e6


def measured(command):
    """(exit code, peak of resident memory [MB], processor time [s], messages) of a process of its own."""
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    messages = process.stderr.read()
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    return process.returncode, usage.ru_maxrss / 1024, usage.ru_utime + usage.ru_stime, messages


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("cambium")
    parser.add_argument("--columns", type=int, default=1024, help="directions of a scan")
    parser.add_argument("--memory", type=int, default=400, help="the budget [MiB]")
    parser.add_argument("--check", action="store_true", help="fail when an exporter takes more")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        work = Path(name)
        (work / "spec.yaml").write_text(SPEC.format(columns=options.columns))
        subprocess.run([options.cambium, "simulate", work / "spec.yaml", work / "missions"], check=True, capture_output=True)
        clouds = size_of(work / "missions")
        print(f"clouds: {clouds:.0f} MB; --memory {options.memory}M\n")
        print("| exporter | peak of memory [MB] | processor time [s] | written [MB] |\n|---|---|---|---|")
        known = subprocess.run([options.cambium, "plugins", "list"], capture_output=True, text=True, check=True).stdout
        over = []
        for exporter, params in EXPORTS.items():
            if exporter not in known.split():
                continue
            (work / "p.yaml").write_text(
                f"version: 1\nsteps:\n  - georeference: similarity_4dof\n  - export: {exporter}\n    params: {params}\n")
            out = work / f"out_{exporter}"
            code, peak, seconds, messages = measured(
                [options.cambium, "run", work / "p.yaml", work / "missions" / "robot", "--out", out, "--cache", "none",
                 "--memory", f"{options.memory}M", "--threads", "2"])
            assert code == 0, messages
            print(f"| `{exporter}` | {peak:.0f} | {seconds:.0f} | {size_of(out / exporter):.0f} |", flush=True)
            if peak > options.memory:
                over.append(exporter)
        if options.check:
            assert clouds > 1.2 * options.memory, "the clouds fit into memory: nothing is shown"
            assert not over, f"more than --memory {options.memory}M: {over}"
    return 0


if __name__ == "__main__":
    sys.exit(main())
