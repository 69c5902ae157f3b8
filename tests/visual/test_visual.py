# SPDX-License-Identifier: BSD-3-Clause
"""Pictures from a simulated camera to the ledger: places are found, and a changed picture is noticed.

Arguments: the program, the source folder. Exit code 77: the plugin `visual_bow` was not built.
"""

import json
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent.parent / "support"))
from program import ProgramCase, main  # noqa: E402

PIPELINE = "version: 1\nsteps:\n  - recognize: visual_bow\n    pairs: between_missions\n    params: {candidates: 1}\n"


class Visual(ProgramCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        spec = Path(cls.source, "tests/specs/pictures.yaml").read_text()
        (cls.work / "spec.yaml").write_text(spec.replace("sensor: {", "sensor: {clouds: false, "))
        (cls.work / "visual.yaml").write_text(PIPELINE)
        cls.cambium(cls, "simulate", "spec.yaml", "seen")

    def truth(self, mission):
        rows = (self.work / "seen" / mission / "ground_truth.tum").read_text().splitlines()
        return [tuple(map(float, row.split()[1:4])) for row in rows if not row.startswith("#")]

    def distances(self, query):
        """True distance of each pair that was proposed [m]."""
        out = f"out_{query}"
        self.cambium("run", "visual.yaml", "seen/a_reference", f"seen/{query}", "--out", out)
        places = {name: self.truth(name) for name in ("a_reference", query)}
        pairs = [json.loads(line) for line in (self.work / out / "ledger.jsonl").read_text().splitlines()]
        self.assertEqual({pair["proposed_by"] for pair in pairs}, {"visual_bow"})
        ends = [[places[pair[end]["mission"]][pair[end]["id"]] for end in ("tail", "head")] for pair in pairs]
        return [sum((a - b) ** 2 for a, b in zip(*both)) ** 0.5 for both in ends], len(places[query])

    def test_a_path_walked_again_is_recognised(self):
        found, nodes = self.distances("beside")
        self.assertGreater(sum(d < 5 for d in found) / nodes, 0.75)

    def test_a_changed_picture_is_looked_at_again(self):
        run = ("run", "visual.yaml", "seen/a_reference", "seen/beside", "--out", "out_changed", "--explain")
        self.cambium(*run)
        self.assertIn("recognize visual_bow: nothing changed", self.cambium(*run).stderr)
        first, second = sorted((self.work / "seen/beside/individual_images").iterdir())[:2]
        kept = first.read_bytes()
        first.write_bytes(second.read_bytes())
        self.assertIn("recognize visual_bow: changed: payloads", self.cambium(*run).stderr)
        first.write_bytes(b"\x89PNG")
        self.assertIn(f"{first.name}: cannot be read as a picture", self.cambium(*run, code=4).stderr)
        first.write_bytes(kept)


if __name__ == "__main__":
    main(Visual, "visual_bow")
