# SPDX-License-Identifier: BSD-3-Clause
"""A map written as recordings and read by others: rosbags, Debian's rosbag where it is, and our own reader.

Arguments: the program, the source folder. Exit code 77: no rosbags, or the plugin `python` was not built.
"""

import json
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
from recordings import Recordings, clouds, main, nodes, points

SPEC = Path(__file__).parent / "forest.yaml"
PIPELINE = Path(__file__).parent / "pipeline.yaml"
BAGS = {"ros1_bag": "map.bag", "ros2_bag": "map", "sqlite": "map"}


class Export(Recordings):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.made = cls.work = Path(folder.name)  # one folder for all
        one = cls("cambium")
        one.cambium("simulate", SPEC, "missions")
        one.cambium("run", PIPELINE, "missions/spring", "missions/2 autumn", "--out", "map", "--cache", "none")

    def setUp(self):
        pass

    def messages(self, export):
        """{topic: [(receive time, message)]} by rosbags."""
        from rosbags.highlevel import AnyReader
        from rosbags.typesys import Stores, get_typestore
        found = {}
        with AnyReader([self.made / "map" / export / BAGS[export]],
                       default_typestore=get_typestore(Stores.ROS2_HUMBLE)) as reader:
            for connection, time, raw in reader.messages():
                found.setdefault(connection.topic, []).append((time, reader.deserialize(raw, connection.msgtype)))
        return found

    def poses(self, mission):
        rows = [r.split() for r in (self.made / f"map/{mission}.tum").read_text().splitlines() if not r.startswith("#")]
        return [(*map(int, r[0].split(".")), *map(float, r[1:])) for r in rows]

    def test_every_topic_is_there(self):
        for export in BAGS:
            found = self.messages(export)
            self.assertEqual(set(found), {"/tf", "/tf_static", "/loops", "/stems", *(
                f"/{m}/{t}" for m in ("spring", "m2_autumn") for t in ("cloud", "odometry", "path", "fix"))})
            times = sorted(t for messages in found.values() for t, _ in messages)
            # 20 nodes a second, though half a year lies between the missions.
            self.assertLess(times[-1] - times[0], (len(found["/tf"]) + 1) * 50_000_000)

    def test_clouds_stand_at_their_node_poses(self):
        for export in BAGS:
            found = self.messages(export)
            for mission, name in (("spring", "spring"), ("2 autumn", "m2_autumn")):
                wanted = self.poses(mission)
                transforms = {m.transforms[0].header.stamp.nanosec + 10**9 * m.transforms[0].header.stamp.sec: m.transforms[0]
                              for _, m in found["/tf"] if m.transforms[0].child_frame_id == f"{name}/base"}
                self.assertEqual(len(transforms), len(wanted))
                files = clouds(self.made / "missions" / mission)
                self.assertEqual(len(found[f"/{name}/cloud"]), len(files))
                path = found[f"/{name}/path"][0][1].poses
                for i, (_, cloud) in enumerate(found[f"/{name}/cloud"]):
                    self.assertEqual(cloud.header.frame_id, f"{name}/base")
                    self.assertEqual((cloud.header.stamp.sec, cloud.header.stamp.nanosec), wanted[i][:2])
                    t = transforms[cloud.header.stamp.nanosec + 10**9 * cloud.header.stamp.sec]
                    self.assertEqual(t.header.frame_id, "map")
                    moved, turned = t.transform.translation, t.transform.rotation
                    np.testing.assert_allclose((moved.x, moved.y, moved.z), wanted[i][2:5], atol=1e-6)
                    self.assertAlmostEqual(abs(np.dot((turned.x, turned.y, turned.z, turned.w), wanted[i][5:])), 1, 9)
                    p = path[i].pose.position
                    np.testing.assert_allclose((p.x, p.y, p.z), wanted[i][2:5], atol=1e-6)
                    xyz = np.frombuffer(cloud.data.tobytes(), "<f4").reshape(cloud.width, -1)[:, :3]
                    np.testing.assert_array_equal(xyz, points(files[i]))

    def test_loops_are_green_and_red(self):
        rows = [json.loads(line) for line in (self.made / "map/ledger.jsonl").read_text().splitlines()]
        counts = {s: sum(r["state"] == s for r in rows) for s in ("accepted", "rejected")}
        self.assertTrue(all(counts.values()), counts)
        for export in BAGS:
            markers = self.messages(export)["/loops"][0][1].markers
            self.assertEqual({m.ns: len(m.points) // 2 for m in markers}, counts)
            colours = {m.ns: (m.color.r, m.color.g) for m in markers}
            self.assertGreater(colours["accepted"][1], 3 * colours["accepted"][0])
            self.assertGreater(colours["rejected"][0], 3 * colours["rejected"][1])
            self.assertEqual({m.type for m in markers}, {5})

    def test_stems_are_cylinders_that_stand(self):
        for export in BAGS:
            markers = self.messages(export)["/stems"][0][1].markers
            self.assertGreater(len(markers), 10)
            for m in markers:
                self.assertEqual(m.type, 3)
                self.assertTrue(0.03 < m.scale.x == m.scale.y < 1.5 and m.scale.z == 6)
                q = m.pose.orientation
                self.assertGreater(1 - 2 * (q.x**2 + q.y**2), 0.8)  # its axis, upwards

    def test_fixes_are_where_the_nodes_are(self):
        """Against KML's coordinates, which another exporter wrote."""
        kml = (self.made / "map/kml/tracks.kml").read_text()
        for export in BAGS:
            _, fix = self.messages(export)["/spring/fix"][0]
            self.assertTrue(any(abs(float(c.split(",")[0]) - fix.longitude) < 1e-7 and
                                abs(float(c.split(",")[1]) - fix.latitude) < 1e-7
                                for c in kml.replace("<", " ").replace(">", " ").split() if c.count(",") == 2), fix)

    def test_it_reads_back_as_missions(self):
        first = {}
        for export in BAGS:
            for name, original in (("spring", "spring"), ("m2_autumn", "2 autumn")):
                for source in (f"/{name}/odometry", f"/{name}/path", "/tf"):
                    out = f"{export}_{name}_{source.split('/')[-1]}"
                    self.cambium("import", f"map/{export}/{BAGS[export]}", "--cloud", f"/{name}/cloud", "--odometry", source,
                                 "--node-every", "0m", "--params", f"{{gnss: /{name}/fix, body_frame: {name}/base}}",
                                 "--out", out)
                    again = self.work / out
                    self.assertEqual([n[:2] for n in nodes(again)], [p[:2] for p in self.poses(original)])
                    np.testing.assert_allclose([n[2:5] for n in nodes(again)], [p[2:5] for p in self.poses(original)], atol=1e-6)
                    for a, b in zip(clouds(again), clouds(self.made / "missions" / original)):
                        np.testing.assert_array_equal(points(a), points(b))
                    one = first.setdefault((name, source), again)
                    for file in (p for p in one.rglob("*") if p.is_file()):
                        self.assertEqual(file.read_bytes(), (again / file.relative_to(one)).read_bytes())

    def test_rviz_files_name_topics_that_are_there(self):
        from ruamel.yaml import YAML  # what rosbags itself reads YAML with
        for export, package in (("ros1_bag", "rviz/"), ("ros2_bag", "rviz_default_plugins/")):
            config = YAML(typ="safe").load((self.made / f"map/{export}/map.rviz").read_text())
            shown = config["Visualization Manager"]["Displays"]
            self.assertTrue(all(d["Class"].startswith(package) for d in shown))
            topics = [d.get("Topic") or d.get("Marker Topic") for d in shown if d["Class"].split("/")[1] not in ("Grid", "TF")]
            topics = [t["Value"] if isinstance(t, dict) else t for t in topics]
            self.assertEqual(len(topics), 6)
            self.assertLessEqual(set(topics), set(self.messages(export)))

    def test_debians_rosbag_reads_it(self):
        script = ("import rosbag, sys\nb = rosbag.Bag(sys.argv[1])\n"
                  "print(sum(1 for _ in b.read_messages(raw=True)), sorted(b.get_type_and_topic_info()[1]))\n")
        done = subprocess.run(["/usr/bin/python3", "-c", script, self.made / "map/ros1_bag/map.bag"], text=True,
                              capture_output=True)
        if "No module named 'rosbag'" in done.stderr:
            self.skipTest("Debian's python3-rosbag is not installed")
        self.assertEqual(done.returncode, 0, done.stderr)
        found = self.messages("ros1_bag")
        self.assertEqual(done.stdout.split(" ", 1), [str(sum(map(len, found.values()))), f"{sorted(found)}\n"])

    def test_a_full_disk(self):
        """No file can grow beyond 200 KB: an error that names the file, which is not there."""
        for export, more, name in (("ros1_bag", "", "map.bag"), ("ros2_bag", "", "map"),
                                   ("ros2_bag", "    params: {storage: sqlite3}\n", "map")):
            (self.work / "full.yaml").write_text(f"version: 1\nsteps:\n  - export: {export}\n{more}")
            shutil.rmtree(self.work / "full", ignore_errors=True)
            done = subprocess.run(["bash", "-c", "ulimit -f 200; trap '' XFSZ; exec \"$@\"", "_", self.program, "run",
                                   "full.yaml", "missions/spring", "--out", "full", "--cache", "none"], cwd=self.work,
                                  text=True, capture_output=True, env={**os.environ, "VIRTUAL_ENV": sys.prefix})
            self.assertEqual(done.returncode, 4, done.stderr)
            self.assertIn(f"full/{export}/{name}: cannot be written", done.stderr)
            self.assertEqual(list((self.work / "full" / export).iterdir()), [])

    def test_the_same_bytes_again(self):
        self.cambium("run", PIPELINE, "missions/2 autumn", "missions/spring", "--out", "again", "--cache", "none",
                     "--threads", "1")
        for export in BAGS:
            for file in (p for p in (self.made / "map" / export).rglob("*") if p.is_file()):
                again = self.work / "again" / file.relative_to(self.made / "map")
                self.assertEqual(file.read_bytes(), again.read_bytes(), file)


if __name__ == "__main__":
    main(Export)
