# SPDX-License-Identifier: BSD-3-Clause
"""Missions, a pipeline and its result on one machine, for runs in pieces to be compared with."""

import subprocess
from pathlib import Path

SPEC = """\
version: 1
seed: 3
stand: {size: [60, 50], density: 700}
sensor: {beams: 12, columns: 240, max_range: 30}
path: {kind: loop, size: [26, 14], spacing: 3}
missions: [{name: a}, {name: b, path: {offset: 1, reversed: true}}]
"""

PIPELINE = """\
version: 1
steps:
  - recognize: scan_context
    params: {candidates: 1}
  - register: gicp
    params: {min_overlap: 0.2}
  - verify: pairwise_consistency
  - optimize: ceres
  - recognize: proximity
    params: {radius: 5.0}
  - register: gicp
    params: {min_overlap: 0.2}
  - verify: pairwise_consistency
  - optimize: ceres
  - evaluate: ate
  - export: plan
"""


class Study:
    """A folder with missions/, pipeline.yaml, plan.json and local/, the run to compare with."""

    def __init__(self, cambium, folder):
        self.cambium, self.folder = cambium, Path(folder)
        (self.folder / "spec.yaml").write_text(SPEC)
        (self.folder / "pipeline.yaml").write_text(PIPELINE)
        self.run("simulate", "spec.yaml", "missions", "--quiet")
        missions = ["missions/a", "missions/b"]
        self.run("run", "pipeline.yaml", *missions, "--out", "local", "--cache", "local_cache")
        self.run("plan", "pipeline.yaml", *missions, "-o", "plan.json")

    def run(self, *arguments):
        """Runs cambium in the folder; what it printed."""
        done = subprocess.run([self.cambium, *arguments], cwd=self.folder, text=True,
                              capture_output=True)
        assert done.returncode == 0, f"cambium {arguments}:\n{done.stdout}{done.stderr}"
        return done.stdout

    def files(self, out):
        """Content of the files of a run folder by name, without what tells times: report.json,
        and the part "run" at the end of report.html."""
        folder = self.folder / out
        files = {str(f.relative_to(folder)): f.read_bytes() for f in sorted(folder.rglob("*"))
                 if f.is_file() and f.name != "report.json"}
        page, mark, _ = files["report.html"].partition(b'id="run"')
        assert mark, "report.html has no part that tells times"
        return files | {"report.html": page}
