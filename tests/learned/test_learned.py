# SPDX-License-Identifier: BSD-3-Clause
"""Networks as place recognisers, end to end on a simulated stand: learned_bev with its own network, and the
script of docs/learned-recognisers.md on the same network.

Arguments: the program, the source folder. Exit code 77: learned_bev was not built.
"""

import json
import re
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent.parent / "support"))
from program import ProgramCase, main  # noqa: E402

PIPELINE = """version: 1
missions: [missions/mission_a, missions/mission_b]
steps:
  - filter: range_crop
    params: {max_range: 30.0}
  - recognize: PLUGIN
    pairs: between_missions
    params: {PARAMS}
  - register: gicp
    params: {min_overlap: 0.4}
  - verify: pairwise_consistency
  - evaluate: loops
"""


class Learned(ProgramCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.cambium(cls, "simulate", Path(cls.source, "framework/templates/forest.yaml.in"), "missions")

    def loops(self, name, plugin, params):
        (self.work / f"{name}.yaml").write_text(PIPELINE.replace("PLUGIN", plugin).replace("PARAMS", params))
        self.cambium("run", f"{name}.yaml", "--out", name)
        metrics = json.loads((self.work / name / "report.json").read_text())["metrics"]
        return {m["name"]: m["value"] for m in metrics}

    def test_the_network_inside_ties_two_missions(self):
        found = self.loops("own", "learned_bev", "candidates: 3")
        self.assertEqual(found["loops.precision"], 1)
        self.assertGreater(found["loops.accepted"], 30)

    def test_the_script_of_the_page_does_the_same(self):
        if subprocess.run([self.program, "plugins", "describe", "python"], capture_output=True).returncode:
            self.skipTest("the plugin python is not built")
        page = Path(self.source, "docs/learned-recognisers.md").read_text()
        script = re.search(r"```python file=onnx_place.py\n(.*?)```", page, re.DOTALL)[1]
        (self.work / "onnx_place.py").write_text(script)
        compile(script, "onnx_place.py", "exec")
        model = Path(self.source, "plugins/place_recognizer/learned_bev/model/small.onnx")
        python = Path(self.environment.get("VIRTUAL_ENV", "/usr"), "bin/python3")
        if subprocess.run([python, "-c", "import onnxruntime"], capture_output=True).returncode:
            self.skipTest(f"{python} has no onnxruntime")
        found = self.loops("script", "python", f"script: onnx_place.py, model: {model}, candidates: 3")
        self.assertEqual(found["loops.precision"], 1)
        self.assertGreater(found["loops.accepted"], 30)


if __name__ == "__main__":
    main(Learned, "learned_bev")
