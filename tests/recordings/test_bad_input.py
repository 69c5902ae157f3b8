# SPDX-License-Identifier: BSD-3-Clause
"""What is wrong with a recording, or with what was asked of it, and what is said about it.

Arguments: the program, the source folder. Exit code 77: no rosbags, or the plugin `python` was not built.
"""

import os
import shutil
import subprocess
import sys
from pathlib import Path

from recordings import Recordings, clouds, main

try:
    from made_bags import START, Made, points_at, walk, xyz
except ImportError:
    pass  # main() says so


class BadInput(Recordings):
    def walk(self, name="walk.bag", **more):
        with Made(self.work / name) as bag:
            walk(bag, **more)
        return self.work / name

    def test_a_recording_that_was_cut_off(self):
        """Wherever: refused, with what is whole of it, and nothing written."""
        for name, repair in (("walk.bag", "rosbag reindex"), ("walk_mcap", "mcap recover"), ("walk_db3", ".dump")):
            whole = self.walk(name, seconds=200)
            file = whole if whole.is_file() else whole / f"{name}.{name[5:]}"
            content = file.read_bytes()
            for tenth in (1, 5, 9):
                file.write_bytes(content[:len(content) * tenth // 10])
                said = self.bring_in(file, "--odometry", "/odom", code=4)
                self.assertIn(f"{file}: the recording is cut off", said)
                self.assertIn(repair, said)
                if tenth == 9 and name != "walk_db3":
                    # 200 clouds, 2002 poses and one transform were written.
                    messages = int(said.split(" messages in ")[0].split()[-1])
                    self.assertTrue(1000 < messages < 2203, said)
            file.write_bytes(content[:-1])
            self.assertIn("cut off", self.bring_in(file, code=4))
            file.write_bytes(b"")
            self.assertIn("0 bytes", self.bring_in(file, code=4))
            file.write_bytes(content)
            self.bring_in(file, name=f"whole_{name}")

    def test_a_recorder_that_was_killed_leaves_no_index(self):
        """ROS 1 and MCAP write theirs at the end; the header of the bag then says that there is none."""
        file = self.walk()
        content = file.read_bytes()
        at = content.index(b"index_pos=") + len(b"index_pos=")
        file.write_bytes(content[:at] + bytes(8) + content[at + 8:])
        self.assertIn("cut off", self.bring_in(file, code=4))

    def test_a_damaged_recording(self):
        for name in ("walk.bag", "walk_mcap", "walk_db3"):
            whole = self.walk(name)
            file = whole if whole.is_file() else whole / f"{name}.{name[5:]}"
            content = bytearray(file.read_bytes())
            content[len(content) // 4:len(content) // 2] = bytes(len(content) // 2 - len(content) // 4)
            file.write_bytes(content)
            self.assertIn(f"error: {file}", self.bring_in(file, code=4))
            file.write_bytes(os.urandom(3000))
            self.assertIn(f"error: {file}", self.bring_in(file, code=4))

    def test_a_topic_that_is_not_there(self):
        file = self.walk()
        said = self.bring_in(file, "--cloud", "/poinst", code=2)
        self.assertIn("'cloud': there is no topic '/poinst'; did you mean '/points'?", said)
        self.assertIn("\n  /odom  nav_msgs/msg/Odometry  (102 messages)", said)
        self.assertIn("\n  /points  sensor_msgs/msg/PointCloud2  (10 messages)", said)
        said = self.bring_in(file, "--odometry", "/qwertz", code=2)
        self.assertNotIn("did you mean", said)
        self.bring_in(file, "--odometry", "odom", name="without_the_slash")

    def test_a_topic_of_another_type(self):
        said = self.bring_in(self.walk(), "--cloud", "/odom", code=2)
        self.assertIn("topic '/odom' is of type nav_msgs/msg/Odometry; expected clouds (sensor_msgs/msg/PointCloud2)", said)
        self.assertIn("Topics that fit:\n  /points", said)
        said = self.bring_in(self.work / "walk.bag", "--params", "{gnss: /points}", code=2)
        self.assertIn("expected fixes (sensor_msgs/msg/NavSatFix). No topic of the recording fits.", said)

    def test_several_topics_that_could_be_meant(self):
        with Made(self.work / "two.bag") as bag:
            walk(bag)
            walk(bag, clouds="/more", odometry="/other")
        said = self.bring_in("two.bag", code=2)
        self.assertIn("several topics hold clouds; name one with 'cloud':\n  /more", said)
        said = self.bring_in("two.bag", "--cloud", "/more", code=2)
        self.assertIn("several topics hold poses; name one with 'odometry'", said)
        self.bring_in("two.bag", "--cloud", "/more", "--odometry", "/other", name="named")

    def test_clouds_and_poses_of_different_times(self):
        with Made(self.work / "late.bag") as bag:
            for i in range(20):
                bag.put("/odom", START + i, bag.odometry(START + i * 10**8, (i, 0, 0)))
                bag.put("/points", START + i, bag.cloud(START + 3600 * 10**9 + i * 10**8, xyz(points_at(1)), "base_link"))
        said = self.bring_in("late.bag", code=4)
        self.assertIn("no cloud of topic '/points' has a pose: the clouds go from 1700003600.000 s to 1700003601.900 s, the "
                      "poses 1700000000.000 s to 1700000001.900 s", said)

    def test_clouds_in_a_gap_of_the_poses_are_left_out_and_counted(self):
        with Made(self.work / "gap.bag") as bag:
            for i in range(100):
                time = START + i * 10**8
                if not 30 <= i < 70:
                    bag.put("/odom", time, bag.odometry(time, (0.1 * i, 0, 0)))
                bag.put("/points", time + 1, bag.cloud(time + 1, xyz(points_at(1)), "base_link"))
        said = self.cambium("import", "gap.bag", "--node-every", "0m", "--out", "m")
        # One in the gap for each missing pose and the one before it, and one behind the last pose.
        self.assertIn("42 clouds were left out: no pose within 1 s on both sides", said)
        self.assertEqual(len(clouds(self.work / "m")), 58)
        self.cambium("import", "gap.bag", "--node-every", "0m", "--params", "{max_gap: 5}", "--out", "filled")
        self.assertEqual(len(clouds(self.work / "filled")), 99)

    def test_stamps_that_go_back(self):
        with Made(self.work / "back.bag") as bag:
            bag.put("/odom", START, bag.odometry(START, (0, 0, 0)))
            bag.put("/odom", START, bag.odometry(START + 10**9, (10, 0, 0)))
            for i, at in enumerate((1, 5, 5, 3, 9)):
                bag.put("/points", START + i, bag.cloud(START + at * 10**8, xyz(points_at(1)), "base_link"))
        self.assertIn("2 clouds were left out: their stamps do not come after", self.cambium("import", "back.bag", "--out", "m"))
        self.assertEqual(len(clouds(self.work / "m")), 3)

    def test_an_empty_recording(self):
        for name in ("empty.bag", "empty_mcap", "empty_db3"):
            with Made(self.work / name):
                pass
            self.assertIn(name, self.bring_in(name, code=4))

    def test_a_cloud_that_contradicts_itself(self):
        good = xyz(points_at(1))
        def change(**more):
            def apply(cloud):
                for name, value in more.items():
                    setattr(cloud, name, value)
            return apply
        wrong = {"lacks the field 'z'": lambda c: c.fields.pop(),
                 "brings 719 bytes": lambda c: setattr(c, "data", c.data[:-1]),
                 "in rows of 12": change(height=2, row_step=12),
                 "the field 'z' ends at byte 12 of a point of 10": change(point_step=10),
                 "has the datatype 9": lambda c: setattr(c.fields[0], "datatype", 9)}
        for i, (expected, spoil) in enumerate(wrong.items()):
            with Made(self.work / f"{i}.bag") as bag:
                cloud = bag.cloud(START, good)
                spoil(cloud)
                bag.put("/c", START, cloud)
            said = self.bring_in(f"{i}.bag", "--odometry", "none", code=4)
            self.assertIn(expected, said)
            self.assertIn("topic '/c', stamp 1700000000.000000000", said)

    def test_poses_that_are_none(self):
        with Made(self.work / "nan.bag") as bag:
            bag.put("/odom", START, bag.odometry(START, (float("nan"), 0, 0)))
            bag.put("/points", START, bag.cloud(START, xyz(points_at(1)), "base_link"))
        self.assertIn("topic '/odom': the pose at 1700000000.000000000 s is (nan", self.bring_in("nan.bag", code=4))

    def test_a_lidar_that_nothing_ties_to_the_robot(self):
        with Made(self.work / "loose.bag") as bag:
            for i in range(2):
                bag.put("/odom", START + i, bag.odometry(START + i * 10**8, (0, 0, 0)))
            bag.put("/points", START, bag.cloud(START, xyz(points_at(1))))
        said = self.bring_in("loose.bag", code=4)
        self.assertIn("tf does not say where the clouds' frame 'lidar' is on 'base_link'", said)
        self.bring_in("loose.bag", "--params", "{extrinsic: [0, 0, 0, 0, 0, 0, 1]}", name="told")

    def test_no_poses_at_all(self):
        with Made(self.work / "still.bag") as bag:
            bag.put("/points", START, bag.cloud(START, xyz(points_at(1))))
        said = self.bring_in("still.bag", code=4)
        self.assertIn("no topic holds poses", said)
        self.assertIn("with 'odometry: none' the sensor stood still", said)

    def test_options_that_make_no_sense(self):
        file = self.walk()
        self.assertIn("node_every: expected a distance or a time, such as 2m or 0.5s, found '2 miles'",
                      self.bring_in(file, "--node-every", "2 miles", code=2))
        self.assertIn("did you mean", self.bring_in(file, "--params", "{max_gab: 1}", code=2))
        self.assertIn("tf has no frame 'base'", self.bring_in(file, "--odometry", "/tf_static", "--params",
                                                              "{body_frame: base}", code=2))

    def test_a_folder_that_holds_something_stays_as_it_is(self):
        file = self.walk()
        (self.work / "m").mkdir()
        (self.work / "m/mine").write_text("mine")
        self.assertIn("is there already", self.cambium("import", file, "--out", "m", code=2))
        self.assertEqual([p.name for p in (self.work / "m").iterdir()], ["mine"])

    def test_a_full_disk(self):
        """No file can grow beyond 4 KB: an error, and no mission."""
        with Made(self.work / "big.bag") as bag:
            bag.put("/c", START, bag.cloud(START, xyz(points_at(1, 2000))))
        done = subprocess.run(["bash", "-c", "ulimit -f 4; trap '' XFSZ; exec \"$@\"", "_", self.program, "import", "big.bag",
                               "--odometry", "none", "--out", "m"], cwd=self.work, text=True, capture_output=True,
                              env={**os.environ, "VIRTUAL_ENV": sys.prefix})
        self.assertEqual(done.returncode, 4, done.stderr)
        self.assertEqual([p.name for p in self.work.iterdir()], ["big.bag"])

    def test_without_rosbags(self):
        """What to install, and into which Python."""
        file = self.walk()
        environment = {k: v for k, v in os.environ.items() if k != "VIRTUAL_ENV"}
        if subprocess.run(["/usr/bin/python3", "-c", "import rosbags"], capture_output=True).returncode == 0:
            self.skipTest("/usr/bin/python3 has rosbags of its own")
        done = subprocess.run([self.program, "import", file, "--out", "m"], cwd=self.work, text=True, capture_output=True,
                              env=environment)
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertIn("need the Python package rosbags, which /usr/bin/python3 does not have", done.stderr)
        self.assertIn("pip install rosbags", done.stderr)

    def test_scripts_of_another_build(self):
        """Results in the cache would not show that they were changed, so they are refused."""
        file, plugins = self.walk(), Path(self.program).parent.parent / "lib/cambium/plugins"
        here = self.work / "prefix/lib/cambium/plugins"
        shutil.copytree(plugins / "python", here / "python")
        shutil.copy(plugins / "python.so", here)
        (self.work / "prefix/bin").mkdir()
        program = shutil.copy(self.program, self.work / "prefix/bin")
        environment = {**os.environ, "VIRTUAL_ENV": sys.prefix}
        command = [program, "import", file, "--out", self.work / "m"]
        subprocess.run(command, check=True, capture_output=True, env=environment)
        script = here / "python/cambium_recordings/names.py"
        script.write_text(script.read_text() + "# changed\n")
        command[-1] = self.work / "n"
        done = subprocess.run(command, text=True, capture_output=True, env=environment)
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertIn("its files are not those that this Cambium was built with", done.stderr)


if __name__ == "__main__":
    main(BadInput)
