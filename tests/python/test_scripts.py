# SPDX-License-Identifier: BSD-3-Clause
"""Scripts as a user meets them: written by `plugins new --python`, run by a pipeline, changed, run again.

Arguments: the program, the source folder. Exit code 77: the plugin `python` was not built.
"""

import json
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent.parent / "support"))
from program import ProgramCase, main  # noqa: E402

STEPS = {"payload_filter": "filter", "place_recognizer": "recognize", "registration": "register",
         "map_exporter": "export", "evaluator": "evaluate"}

# Whoever asks for NumPy's functions lets go of the interpreter's lock for a while.
SLOW_NUMPY = """
import builtins, time
plain_import = builtins.__import__
def slow_import(name, *rest, **more):
    if name == "numpy.core.multiarray":
        time.sleep(0.3)
    return plain_import(name, *rest, **more)
builtins.__import__ = slow_import
"""


class Scripts(ProgramCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.cambium(cls, "plugins", "new", "evaluator", "any", "--python")
        cls.cambium(cls, "simulate", "any/forest.yaml", "missions")

    def new(self, kind, name):
        self.cambium("plugins", "new", kind, name, "--python")
        (self.work / name / "missions").symlink_to("../missions")
        return self.work / name

    def test_every_kind_runs_as_it_is_written(self):
        for kind, verb in STEPS.items():
            folder = self.new(kind, f"my_{kind}")
            quick = ("--set", "register.points=100") if kind == "registration" else ()
            self.cambium("run", f"{folder.name}/my_{kind}.yaml", "--out", f"out_{kind}", *quick)
            steps = json.loads((self.work / f"out_{kind}/report.json").read_text())["steps"]
            self.assertIn((verb, "python"), [(s["verb"], s["plugin"]) for s in steps])
        metrics = json.loads((self.work / "out_evaluator/report.json").read_text())["metrics"]
        self.assertIn("python.my_evaluator.mission_a.mean", [m["name"] for m in metrics])
        self.assertTrue((self.work / "out_map_exporter/python/mission_b.csv").exists())
        loops = {m["name"]: m["value"] for m in
                 json.loads((self.work / "out_place_recognizer/report.json").read_text())["metrics"]}
        self.assertEqual(loops["loops.precision"], 1)

    def test_threads_do_not_wait_for_each_others_first_array(self):
        script = self.new("registration", "slow_numpy") / "slow_numpy.py"
        script.write_text(f"{SLOW_NUMPY}\n{script.read_text()}")
        self.cambium("run", "slow_numpy/slow_numpy.yaml", "--out", "out_slow_numpy", "--threads", "8",
                     "--set", "register.points=100", within=300)

    def test_a_reader_is_found_from_the_run_folder_too(self):
        self.new("mission_reader", "my_reader")
        self.cambium("run", "my_reader/my_reader.yaml", "--out", "out_reader")
        resolved = (self.work / "out_reader/resolved.yaml").read_text()
        self.assertIn(str(self.work / "my_reader/my_reader.py"), resolved)
        self.cambium("run", "out_reader/resolved.yaml", "--out", "again")
        self.assertEqual((self.work / "out_reader/walked.tum").read_bytes(),
                         (self.work / "again/walked.tum").read_bytes())

    def test_a_changed_script_is_computed_again_and_a_moved_one_is_not(self):
        folder = self.new("evaluator", "changing")
        run = ("run", "changing/changing.yaml", "--out", "out_changing", "--explain")
        self.cambium(*run)
        said = self.cambium(*run).stderr
        self.assertIn("why: evaluate python: nothing changed", said)
        script = folder / "changing.py"
        script.write_text(script.read_text() + "# another comment\n")
        self.assertIn("why: evaluate python: changed: files", self.cambium(*run).stderr)
        script.rename(folder / "moved.py")
        said = self.cambium(*run, "--set", "evaluate.script=changing/moved.py").stderr
        self.assertIn("(1 of 1 items from the cache)", said.replace("nothing changed, taken from the cache",
                                                                    "(1 of 1 items from the cache)"))

    def test_a_changed_helper_is_computed_again(self):
        """Of files beside the script those count that it imports, and what these import."""
        folder = self.new("evaluator", "helped")
        script = folder / "helped.py"
        script.write_text(script.read_text().replace("import numpy", "import outer\nimport numpy", 1)
                          .replace("metrics = []", "metrics = list(outer.first())"))
        (folder / "outer.py").write_text("def first():\n    from inner import things  # only when called\n"
                                         "    return things\n")
        (folder / "inner.py").write_text("from cambium import Metric\nthings = [Metric('helped', 1.5)]\n")
        (folder / "stranger.py").write_text("raise RuntimeError('nobody imports this')\n")
        run = ("run", "helped/helped.yaml", "--out", "out_helped", "--explain")
        self.cambium(*run)
        self.assertIn("python: nothing changed", self.cambium(*run).stderr)
        (folder / "stranger.py").write_text("changed\n")
        self.assertIn("python: nothing changed", self.cambium(*run).stderr)
        for helper, old, new in (("inner.py", "1.5", "2.5"), ("outer.py", "only", "just")):
            text = (folder / helper).read_text()
            (folder / helper).write_text(text.replace(old, new))
            self.assertIn("why: evaluate python: changed: files", self.cambium(*run).stderr)
        metrics = json.loads((self.work / "out_helped/report.json").read_text())["metrics"]
        self.assertIn(("python.helped.helped", 2.5), [(m["name"], m["value"]) for m in metrics])

    def test_mistakes_name_their_places(self):
        folder = self.new("evaluator", "wrong")
        pipeline, script = folder / "wrong.yaml", folder / "wrong.py"
        check = ("validate", "wrong/wrong.yaml")
        good = pipeline.read_text()
        pipeline.write_text(good.replace("script: wrong.py", "script: wrong.py, max_time: 1"))
        self.assertRegex(self.cambium(*check, code=2).stderr,
                         r"wrong.yaml:\d+:\d+: unknown parameter 'max_time'")
        pipeline.write_text(good.replace("wrong.py", "wring.py"))
        self.assertRegex(self.cambium(*check, code=2).stderr, r"wrong.yaml:\d+:\d+: 'script': there is no file")
        pipeline.write_text(good)
        script.write_text(script.read_text().replace("metrics = []", "metrics = [][0]"))
        line = 1 + script.read_text()[:script.read_text().index("[][0]")].count("\n")
        said = self.cambium("run", "wrong/wrong.yaml", "--out", "out_wrong", code=3).stderr
        self.assertRegex(said, rf"wrong.py:{line}: IndexError: list index out of range")
        self.assertIn("in evaluate\n    metrics = [][0]", said)

    def test_kinds_without_a_python_side_say_so(self):
        said = self.cambium("plugins", "new", "solver", "my_solver", "--python", code=2).stderr
        self.assertIn("a solver cannot be written in Python", said)

    def test_threads_and_order_change_nothing(self):
        self.new("payload_filter", "threads")
        for threads in ("1", "4"):
            self.cambium("run", "threads/threads.yaml", "--out", f"threads_{threads}", "--threads", threads,
                         "--cache", "none")
        for file in ("fused.g2o", "ledger.jsonl", "mission_b.tum"):
            self.assertEqual((self.work / "threads_1" / file).read_bytes(),
                             (self.work / "threads_4" / file).read_bytes(), file)

    def test_describe_lists_the_parameters_of_a_script(self):
        templates = Path(self.source, "framework/templates")
        said = self.cambium("plugins", "describe", "python", "--set",
                            f"script={templates / 'place_recognizer.py'}").stdout
        self.assertIn("| `rings` | 40 | 1 <= value <= 200 | Fewer forgive", said)

    def test_the_page_shows_the_recogniser_that_plugins_new_writes(self):
        page = Path(self.source, "docs/python-plugins.md").read_text()
        shown = re.search(r"```python file=my_method.py\n(.*?)```", page, re.DOTALL)[1]
        self.assertEqual(shown, Path(self.source, "framework/templates/place_recognizer.py").read_text())
        self.assertLess(len(shown.splitlines()), 40)


if __name__ == "__main__":
    main(Scripts, "python")
