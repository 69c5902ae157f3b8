# SPDX-License-Identifier: BSD-3-Clause
"""`cambium plugins bench`: rows for the plugin and the others of its kind, on the kit's forest and on recordings.
Times are not judged here.

Arguments: the program, the source folder.
"""

import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path


class Bench(unittest.TestCase):
    program = source = None

    def bench(self, *arguments, code=0):
        done = subprocess.run([self.program, "plugins", "bench", *arguments], text=True, capture_output=True)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done

    def rows(self, *arguments):
        return json.loads(self.bench(*arguments, "--json", "--seconds", "0").stdout)["rows"]

    def test_recognisers_side_by_side(self):
        rows = self.rows("scan_context")
        self.assertEqual([r["name"] for r in rows[:3]], ["scan_context"] * 3)
        self.assertIn("proximity", [r["name"] for r in rows])
        self.assertLess(rows[0]["points"] * 10, rows[2]["points"])
        self.assertEqual((rows[2]["recall"], rows[2]["precision"]), (1, 1))
        self.assertGreater(rows[2]["milliseconds"], 0)
        table = self.bench("scan_context", "--alone", "--seconds", "0").stdout
        self.assertEqual(table.count("| scan_context |"), 3)

    def test_parameters_are_used(self):
        self.assertEqual(self.rows("scan_context", "--alone", "--set", "threshold=0")[2]["recall"], 0)
        said = self.bench("scan_context", "--set", "threshhold=1", code=2).stderr
        self.assertIn("did you mean 'threshold'?", said)

    def test_recordings(self):
        with tempfile.TemporaryDirectory() as folder:
            spec = Path(self.source, "framework/templates/forest.yaml.in")
            subprocess.run([self.program, "simulate", spec, f"{folder}/m"], check=True, capture_output=True)
            rows = self.rows("scan_context", "--alone", "--data", f"{folder}/m/mission_a", "--data",
                             f"{folder}/m/mission_b")
        self.assertEqual(len(rows), 3)
        self.assertGreater(rows[2]["recall"], 0.9)

    def test_mistakes(self):
        self.assertIn("did you mean 'scan_context'?", self.bench("scan_contxt", code=2).stderr)
        self.assertIn("expected two missions", self.bench("gicp", "--data", "one", code=2).stderr)


if __name__ == "__main__":
    Bench.program, Bench.source = sys.argv[1:3]
    unittest.main(argv=sys.argv[:1], verbosity=2)
