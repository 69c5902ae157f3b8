# SPDX-License-Identifier: BSD-3-Clause
"""Recordings become mission folders: container formats, layouts of clouds, sources of poses, fixes, images.

Arguments: the program, the source folder. Exit code 77: no rosbags, or the plugin `python` was not built.
"""

import math

import numpy as np
from recordings import Recordings, cloud, clouds, main, nodes, points

try:
    from made_bags import START, Made, points_at, walk, xyz
except ImportError:
    pass  # main() says so

FORMATS = ("walk.bag", "walk_mcap", "walk_db3")


class Import(Recordings):
    def test_every_format_gives_the_same_mission(self):
        made = []
        for name in FORMATS:
            with Made(self.work / name) as bag:
                walk(bag)
            made.append(self.bring_in(name, "--cloud", "/points", "--odometry", "/odom", "--node-every", "2m", name=f"m_{name}"))
        # rosbag2's files alone, too
        made.append(self.bring_in("walk_mcap/walk_mcap.mcap", name="mcap_file"))
        made.append(self.bring_in("walk_db3/walk_db3.db3", name="db3_file"))
        files = sorted(p.relative_to(made[0]) for p in made[0].rglob("*") if p.is_file())
        self.assertEqual(len(files), 2 + 5)
        for other in made[1:]:
            self.assertEqual(sorted(p.relative_to(other) for p in other.rglob("*") if p.is_file()), files)
            for file in files:
                self.assertEqual((other / file).read_bytes(), (made[0] / file).read_bytes(), (other, file))

    def test_compressed_recordings(self):
        from rosbags.rosbag1 import Writer
        from rosbags.rosbag2 import CompressionFormat, CompressionMode
        with Made(self.work / "plain.bag") as bag:
            walk(bag)
        plain = self.bring_in("plain.bag", name="plain")
        made = [(f"{f.name}.bag", (f,)) for f in Writer.CompressionFormat]
        made += [(f"{m.name}_{s}", (m, CompressionFormat.ZSTD)) for m in (CompressionMode.FILE, CompressionMode.MESSAGE)
                 for s in ("mcap", "db3")]
        for name, how in made:
            bag = Made(self.work / name)
            bag.writer.set_compression(*how)
            with bag:
                walk(bag)
            other = self.bring_in(name, name=f"m_{name}")
            for file in (p for p in plain.rglob("*") if p.is_file()):
                self.assertEqual(file.read_bytes(), (other / file.relative_to(plain)).read_bytes(), name)

    def test_poses_are_those_of_the_stamps_of_the_clouds(self):
        with Made(self.work / "walk.bag") as bag:
            walk(bag)
        mission = self.bring_in("walk.bag", "--node-every", "1m")
        found = nodes(mission)
        self.assertEqual(len(found), 10)
        for k, (sec, nsec, x, y, z, *q) in enumerate(found):
            self.assertEqual((sec, nsec), (START // 10**9 + k, 50_000_000))
            self.assertAlmostEqual(x, k + 0.05, 12)  # halfway between two poses
            yaw = 0.1 * k + 0.005
            np.testing.assert_allclose(q, [0, 0, math.sin(yaw / 2), math.cos(yaw / 2)], atol=1e-12)
            # The lidar sits 0.5 m above the body, turned by 90 degrees: x forward is y of the body.
            scan = points_at(k)
            body = np.stack([-scan[:, 1], scan[:, 0], scan[:, 2] + 0.5], axis=1)
            np.testing.assert_allclose(points(clouds(mission)[k]), body, atol=1e-5)
        self.assertEqual(len((mission / "odometry.tum").read_text().splitlines()), 102)
        self.assertIn("0 warnings", self.cambium("inspect", mission))

    def test_clouds_between_nodes_are_left_out_or_accumulated(self):
        with Made(self.work / "walk.bag") as bag:
            walk(bag)
        said = self.cambium("import", "walk.bag", "--node-every", "5m", "--out", "dropped")
        self.assertIn("2 nodes of 2 clouds (8 between nodes left out)", said)
        self.bring_in("walk.bag", "--node-every", "5m", "--between", "accumulate", name="all")
        self.assertEqual(len(points(clouds(self.work / "dropped")[1])), 60)
        everything = points(clouds(self.work / "all")[1])
        self.assertEqual(len(everything), 5 * 60)
        np.testing.assert_array_equal(everything[:60], points(clouds(self.work / "dropped")[1]))
        # The scan of 6 s, seen from the node of 5 s.
        step, yaw = np.array([1.0, 0, 0]), np.array([0.505, 0.605])
        scan = points_at(6)
        body = np.stack([-scan[:, 1], scan[:, 0], scan[:, 2] + 0.5])
        turn = [np.array([[math.cos(a), -math.sin(a), 0], [math.sin(a), math.cos(a), 0], [0, 0, 1]]) for a in yaw]
        np.testing.assert_allclose(everything[60:120].T, turn[0].T @ (turn[1] @ body + step[:, None]), atol=1e-5)

    def test_nodes_by_time(self):
        with Made(self.work / "walk.bag") as bag:
            walk(bag)
        self.assertEqual(len(nodes(self.bring_in("walk.bag", "--node-every", "3s"))), 4)

    def test_every_layout_of_a_cloud(self):
        wanted = np.array([[1, 2, 3], [-4, 5, -6], [7, -8, 9], [10, 11, -12]], float)
        layouts = {"f4": {}, "f8": {}, "i2": {}, "i4": {}, "i1": {}}
        i = 0
        for name in FORMATS:
            with Made(self.work / f"layouts_{name}") as bag:
                for kind in layouts:
                    for big in (False, True):
                        for order in ("xyz", "zyx", "yxz"):
                            for gap, padding, rows in ((0, 0, 1), (3, 5, 2), (4, 0, 4)):
                                columns = [("ring", "u2", [1, 2, 3, 4], gap)]
                                columns += [(a, kind, wanted[:, "xyz".index(a)], gap) for a in order]
                                columns.append(("intensity", "u1" if gap else "f4", [9, 8, 7, 6], 1))
                                time = START + i * 10**9
                                bag.put("/c", time, bag.cloud(time, columns, big=big, padding=padding, rows=rows))
                                i += 1
            mission = self.bring_in(f"layouts_{name}", "--odometry", "none", "--node-every", "0s", name=f"l_{name}")
            self.assertEqual(len(clouds(mission)), 5 * 2 * 3 * 3)
            for file in clouds(mission):
                np.testing.assert_array_equal(points(file), wanted)
                np.testing.assert_array_equal(cloud(file)["intensity"], [9, 8, 7, 6])

    def test_points_that_are_none_are_left_out_and_counted(self):
        with Made(self.work / "a.bag") as bag:
            scan = np.array([[1, 2, 3], [np.nan, 0, 1], [4, 5, 6], [np.inf, 1, 1], [0, 0, 0], [1e300, 1, 1]])
            label = ("label", "u1", [1, 2, 3, 4, 5, 6], 0)
            bag.put("/c", START, bag.cloud(START, [*xyz(scan, "f8"), label]))
        said = self.cambium("import", "a.bag", "--odometry", "none", "--out", "m")
        self.assertIn("3 points were left out: a coordinate is NaN, infinite or beyond a float", said)
        self.assertIn("1 points were left out: they lie at the sensor's origin", said)
        table = cloud(clouds(self.work / "m")[0])
        np.testing.assert_array_equal(table["label"], [1, 3])
        np.testing.assert_array_equal(table["x"], [1, 4])

    def test_every_source_of_poses_says_the_same(self):
        for name in FORMATS[:2]:
            with Made(self.work / name) as bag:
                walk(bag)
                path = []
                for i in range(102):
                    time = START + i * 100_000_000
                    bag.put("/pose", time, bag.stamped(time, (0.1 * i, 0, 0), 0.01 * i))
                    bag.put("/tf", time, bag.tf("odom", "base_link", time, (0.1 * i, 0, 0), 0.01 * i))
                    path.append(bag.stamped(time, (0.1 * i, 0, 0), 0.01 * i))
                    if i % 50 == 1:
                        bag.put("/path", time, bag.new("nav_msgs/Path", header=bag.header("odom", time), poses=list(path)))
            first = self.bring_in(name, "--odometry", "/odom", name=f"odom_{name}")
            body = ("--params", "{body_frame: base_link}")
            for topic, more in (("/pose", body), ("/path", body), ("/tf", ()), ("/tf", ("--params", "{fixed_frame: odom}"))):
                other = self.bring_in(name, "--odometry", topic, *more, name=f"other_{name}_{topic[1:]}_{len(more)}"
                                      if topic != "/tf" else f"tf_{name}_{len(more)}")
                if topic == "/path":  # the last one ends at 10.1 s; its poses are the same
                    self.assertEqual(len(nodes(other)), len(nodes(first)))
                np.testing.assert_allclose(nodes(other), nodes(first), atol=1e-12)
                for a, b in zip(clouds(first), clouds(other)):
                    np.testing.assert_allclose(points(a), points(b), atol=1e-6)

    def test_an_extrinsic_that_is_given_counts(self):
        with Made(self.work / "walk.bag") as bag:
            walk(bag)
        mission = self.bring_in("walk.bag", "--params", "{extrinsic: [1, 2, 3, 0, 0, 0, 1]}")
        np.testing.assert_allclose(points(clouds(mission)[0]), points_at(0) + [1, 2, 3], atol=1e-5)

    def test_fixes_and_images(self):
        covariance = np.array([[4, 1, 0], [1, 9, 0], [0, 0, 16.0]])
        jpeg, png = b"\xff\xd8\xff\xe0 a picture", b"\x89PNG\r\n\x1a\n another"
        for name in FORMATS:
            with Made(self.work / name) as bag:
                walk(bag)
                bag.put("/fix", START, bag.fix(START, (61.5, 25.25, 130.0), 0, covariance))
                bag.put("/fix", START + 1, bag.fix(START + 10**9, (61.5, 25.25, 131.0), -1))
                bag.put("/fix", START + 2, bag.fix(START + 2 * 10**9, (61.5, 25.25, 132.0), 2))
                bag.put("/camera", START, bag.image(START + 40_000_000, jpeg))
                bag.put("/camera", START + 1, bag.image(START + 300_000_000, b"\xff\xd8 farther"))
                bag.put("/camera", START + 2, bag.image(START + 2_100_000_000, png))
                bag.put("/camera", START + 3, bag.image(START + 7_000_000_000, b"far from every node"))
            said = self.cambium("import", name, "--out", f"m_{name}")
            self.assertIn("1 fixes were left out", said)
            self.assertIn("1 fixes have no covariance", said)
            mission = self.work / f"m_{name}"
            self.assertEqual((mission / "gnss.csv").read_text().splitlines(),
                             ["sec,nsec,lat,lon,alt,cov_ee,cov_en,cov_eu,cov_nn,cov_nu,cov_uu",
                              f"{START // 10**9},0,61.500000000,25.250000000,130.000,4,1,0,9,0,16",
                              f"{START // 10**9 + 2},0,61.500000000,25.250000000,132.000,4e-04,0,0,4e-04,0,0.0016"])
            second = START // 10**9
            images = {p.name: p.read_bytes() for p in (mission / "individual_images").iterdir()}
            self.assertEqual(images, {f"image_{second}_050000000.jpg": jpeg, f"image_{second + 2}_050000000.png": png})
            self.assertIn("GNSS fixes    2", self.cambium("inspect", mission))

    def test_a_recording_is_a_mission_of_a_pipeline(self):
        for name, offset in (("walk.bag", 50_000_000), ("walk_mcap", 30_000_000)):
            with Made(self.work / name) as bag:
                walk(bag, offset_of_clouds=offset)
        (self.work / "p.yaml").write_text(
            "version: 1\nmissions:\n  - {path: walk.bag, name: one, params: {node_every: 1m}}\n"
            "  - {path: walk_mcap, name: two, reader: recording, params: {node_every: 2m, odometry: /odom}}\n"
            "steps:\n  - filter: voxel_grid\n  - export: tum\n")
        for threads in (1, 2):
            self.cambium("run", "p.yaml", "--out", f"out{threads}", "--cache", "none", "--threads", threads)
        for name, count in (("one", 10), ("two", 5)):
            track = (self.work / f"out1/{name}.tum").read_bytes()
            self.assertEqual(len([row for row in track.splitlines() if not row.startswith(b"#")]), count)
            self.assertEqual(track, (self.work / f"out2/{name}.tum").read_bytes())

    def test_two_imports_give_the_same_bytes(self):
        with Made(self.work / "walk_mcap") as bag:
            walk(bag)
        for name, threads in (("a", 1), ("b", 2)):
            self.cambium("import", "walk_mcap", "--between", "accumulate", "--out", name, "--threads", threads)
        files = [p for p in (self.work / "a").rglob("*") if p.is_file()]
        for file in files:
            self.assertEqual(file.read_bytes(), (self.work / "b" / file.relative_to(self.work / "a")).read_bytes())


if __name__ == "__main__":
    main(Import)
