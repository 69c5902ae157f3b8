# SPDX-License-Identifier: BSD-3-Clause
"""Real recordings out of ../shared/data/bags: imported, inspected, run through a pipeline, taken there and back.

Arguments: the program, the source folder. Exit code 77: no rosbags, no data, or the plugin `python` was not built.
"""

import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
from recordings import Recordings, clouds, main, nodes, points

NAV2, PLAIN, CAN = "nav2_turtlebot.mcap", "ROS_example.bag", "watercan.bag"
TF, DEPTH = "tf_example", "rosbag2_2023_08_05-16_08_51"


class RealData(Recordings):
    data = None

    def take(self, name, *options, out):
        return self.bring_in(self.data / name, *options, name=out)

    def test_poses_of_every_kind(self):
        """Odometry and tf of one robot; PoseStamped; tf in SQLite."""
        odom = self.take(NAV2, "--cloud", "none", "--odometry", "/odom", "--node-every", "0.5m", out="odom")
        frames = "{fixed_frame: odom, body_frame: base_link}"
        tf = self.take(NAV2, "--cloud", "none", "--odometry", "/tf", "--params", frames, "--node-every", "0.5m", out="tf")
        self.assertEqual(len(nodes(odom)), 66)
        np.testing.assert_allclose(nodes(tf), nodes(odom), atol=1e-9)
        self.assertEqual(len(nodes(self.take(PLAIN, "--cloud", "none", "--odometry", "groundtruth", "--node-every", "0.5m",
                                             out="plain"))), 586)
        two = [self.take(name, "--cloud", "none", "--odometry", "/tf", "--params", "{body_frame: base_link}", "--node-every",
                         "0.1m", out=f"two_{i}") for i, name in enumerate((TF, f"{TF}/tf_example.db3"))]
        self.assertEqual(*((m / "slam_pose_graph.g2o").read_bytes() for m in two))
        self.assertGreater(len(nodes(two[0])), 3)

    def test_clouds_of_a_depth_camera(self):
        mission = self.take(DEPTH, "--odometry", "none", "--node-every", "1s", out="depth")
        self.assertEqual((len(nodes(mission)), len(clouds(mission))), (17, 17))
        self.assertEqual(sum(len(points(c)) for c in clouds(mission)), 665234)

    def test_a_cloud_of_ros_1(self):
        """The same points as rosbags gives, seen without any of our code."""
        from rosbags.highlevel import AnyReader
        with AnyReader([self.data / CAN]) as reader:
            connections = [c for c in reader.connections if c.msgtype.endswith("PointCloud2")]
            _, _, raw = next(reader.messages(connections))
            m = reader.deserialize(raw, connections[0].msgtype)
        at = {f.name: f.offset for f in m.fields}
        bytes_ = m.data.reshape(-1, m.point_step)
        xyz = np.stack([bytes_[:, at[a]:at[a] + 4].copy().view("<f4")[:, 0] for a in "xyz"], axis=1)
        mission = self.take(CAN, "--odometry", "none", out="can")
        np.testing.assert_array_equal(points(clouds(mission)[0]), xyz[np.isfinite(xyz).all(axis=1)])

    def test_there_and_back(self):
        """Real scans of a courtyard: exported at their poses, imported again."""
        archive = self.data.parent.parent / "missions_newer_college"
        mission = next(p.parent for p in sorted(archive.rglob("slam_pose_graph.g2o")))
        (self.work / "p.yaml").write_text("version: 1\nsteps:\n  - export: ros1_bag\n  - export: ros2_bag\n")
        self.cambium("run", "p.yaml", mission, "--out", "map", "--cache", "none")
        for bag in ("map/ros1_bag/map.bag", "map/ros2_bag/map"):
            again = self.bring_in(bag, "--node-every", "0m", "--params", "{odometry: /tf}", name=bag.replace("/", "_"))
            self.assertEqual(len(nodes(again)), len(nodes(mission)))
            np.testing.assert_allclose([n[2:5] for n in nodes(again)], [n[2:5] for n in nodes(mission)], atol=1e-9)
        (self.work / "q.yaml").write_text("version: 1\nsteps:\n  - filter: voxel_grid\n  - recognize: scan_context\n"
                                          "    pairs: within_missions\n  - register: gicp\n  - verify: pairwise_consistency\n"
                                          "  - optimize: sparse_lm\n  - export: tum\n")
        said = self.cambium("run", "q.yaml", again, "--out", "relaxed", "--cache", "none")
        self.assertIn("optimize sparse_lm", said)


if __name__ == "__main__":
    archives = [Path(sys.argv[2]).parent / "shared/data" / f"{name}.tar.xz" for name in ("bags", "missions_newer_college")]
    if missing := [a for a in archives if not a.exists()]:
        print(f"skipped: ../shared/data/{missing[0].name} is not there")
        sys.exit(77)
    with tempfile.TemporaryDirectory() as folder:
        RealData.data = Path(folder) / "bags" / "readers_bags"
        for archive in archives:
            (Path(folder) / archive.name.split(".")[0]).mkdir()
            subprocess.run(["tar", "-xJf", archive, "-C", Path(folder) / archive.name.split(".")[0]], check=True)
        subprocess.run(["tar", "-xJf", RealData.data / f"{DEPTH}.tar.xz", "-C", RealData.data], check=True)
        main(RealData)
