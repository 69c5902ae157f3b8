# SPDX-License-Identifier: BSD-3-Clause
"""Runs in pieces give the bytes of the run on one machine: by hand, by Snakemake, by Slurm.

usage: test_shards.py {by_hand|snakemake|slurm} CAMBIUM SOURCE_DIR"""

import os
import random
import shutil
import subprocess
import sys
import tempfile
import unittest

from slurm import Slurm, SlurmAbsent
from study import Study

SKIPPED = 77


class Shards(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.study = Study(cambium, folder.name)
        self.maxDiff = None

    def assert_is_the_local_run(self, out):
        local, merged = self.study.files("local"), self.study.files(out)
        self.assertEqual(list(local), list(merged))
        for name, content in local.items():
            self.assertTrue(content == merged[name], f"{out}/{name} is not that of the local run")

    def by_hand(self):
        """Any order, a shard twice, a cache each, one shard missing."""
        s, order = self.study, [(wave, i) for wave in (1, 2) for i in (1, 2, 3)]
        random.Random(4).shuffle(order)
        for wave, i in order + order[:1]:
            s.run("run", "plan.json", "--shard", f"{i}/3", "--wave", f"{wave}", "--cache", f"c{i}")
        s.run("merge", "plan.json", "c1", "c2", "c3", "--cache", "merged", "--out", "all")
        self.assert_is_the_local_run("all")
        s.run("merge", "plan.json", "c2", "--cache", "partly_merged", "--out", "partly")
        self.assert_is_the_local_run("partly")

    def shards_leave_nothing_to_register(self):
        """With a shared cache, wave after wave, the merge finds every registration."""
        s = self.study
        for wave in (1, 2):
            for i in (1, 2, 3, 4):
                s.run("run", "plan.json", "--shard", f"{i}/4", "--wave", f"{wave}", "--cache", "c")
        s.run("merge", "plan.json", "--cache", "c", "--out", "all")
        import json
        steps = json.loads((s.folder / "all/report.json").read_text())["steps"]
        for step in steps:
            if step["verb"] in ("recognize", "register"):
                self.assertTrue(step["cached"], step)
        self.assert_is_the_local_run("all")

    def snakemake(self):
        command = ["snakemake", "-s", f"{source}/pipelines/cluster/Snakefile", "--cores", "2",
                   "--config", "plan=plan.json", "shards=3", "cache=shared", "out=snaked",
                   f"cambium={cambium}"]
        done = subprocess.run(command, cwd=self.study.folder, text=True, capture_output=True)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assert_is_the_local_run("snaked")

    def slurm(self):
        with Slurm(self.study.folder / "slurm") as slurm:
            script = f"{source}/pipelines/cluster/slurm.sh"
            done = slurm.run([script, "plan.json", "3", "shared", "slurmed"], self.study.folder,
                             {"CAMBIUM": cambium})
            slurm.wait(done.strip())
        self.assert_is_the_local_run("slurmed")


which, cambium, source = sys.argv[1:]
if which == "snakemake" and not shutil.which("snakemake"):
    print("skipped: snakemake is not installed")
    sys.exit(SKIPPED)
os.environ.pop("CAMBIUM_CACHE", None)
names = ["by_hand", "shards_leave_nothing_to_register"] if which == "by_hand" else [which]
try:
    Slurm.check() if which == "slurm" else None
except SlurmAbsent as absent:
    print(f"skipped: {absent}")
    sys.exit(SKIPPED)
result = unittest.TextTestRunner(verbosity=2).run(unittest.TestSuite(Shards(n) for n in names))
sys.exit(0 if result.wasSuccessful() else 1)
