# SPDX-License-Identifier: BSD-3-Clause
"""Reads ROS recordings: ROS 1 .bag, rosbag2 .db3 and .mcap. docs/recordings.md"""

from pathlib import Path

import numpy as np
from cambium import Error, Mission, MissionReader, Param, above, at_least, in_unit, one_of

from cambium_recordings import need_rosbags
from cambium_recordings.bag import Bag, frame
from cambium_recordings.clouds import TYPE as CLOUD
from cambium_recordings.frames import TYPES as TF
from cambium_recordings.frames import Frames, poses_from_tf
from cambium_recordings.nodes import Nodes, Tally, no_overlap, nodes_of_clouds, source_of, spacing
from cambium_recordings.poses import POSES, StandingStill, TopicPoses, matrix
from cambium_recordings.sides import FIX, IMAGE, fixes_of, write_images, write_odometry


class Recording(MissionReader):
    cloud = Param("", "Topic of PointCloud2; empty: the only one, none: a mission without clouds")
    odometry = Param("", "Topic of the poses: Odometry, PoseStamped, Path, tf; empty: the only one, or tf; none: the "
                         "sensor stood still")
    node_every = Param("2m", "A node when the robot has moved so far (m) or so long after the last one (s)")
    between = Param("drop", "Clouds between two nodes: left out, or moved to the node before them",
                    one_of(["drop", "accumulate"]))
    fixed_frame = Param("", "tf: the frame in which the poses are; empty: the root above the body")
    body_frame = Param("", "The frame whose poses are the nodes, where the topic does not say; empty: base_link or the like "
                           "above the clouds' frame, else that frame")
    extrinsic = Param([], "T_body_cloud as x y z qx qy qz qw in place of what tf says", in_unit("m"))
    max_gap = Param(1.0, "Poses farther apart than this are not interpolated", above(0.0, "s"))
    intensity = Param("intensity", "Field of the clouds that becomes the intensity")
    gnss = Param("", "Topic of NavSatFix; empty: the only one, none: no fixes")
    images = Param("", "Topic of CompressedImage; empty: the only one, none: no images")
    max_image_lag = Param(0.5, "An image belongs to a node if it is no farther away in time", above(0.0, "s"))
    platform_id = Param(0, "The robot, for `platforms:` of a pipeline", at_least(0))
    side_folder = Param("", "Folder for what a mission in memory has no place for: individual_images/ and odometry.tum; "
                            "`cambium import` sets it")

    def __init__(self):
        need_rosbags()
        self._max_gap = int(self.max_gap * 1e9)  # [ns]

    def check_params(self):
        if spacing(self.node_every) is None:
            return f"node_every: expected a distance or a time, such as 2m or 0.5s, found '{self.node_every}'"
        if len(self.extrinsic) not in (0, 7) or len(self.extrinsic) == 7 and not np.linalg.norm(self.extrinsic[3:]) > 0.1:
            return "extrinsic: expected 7 numbers, x y z qx qy qz qw with a quaternion of length 1"
        return ""

    def accepts(self, path):
        return True  # the host has looked at the names

    def read(self, path, context):
        bag = Bag(path)
        cloud = None if self.cloud == "none" else bag.choose(self.cloud, (CLOUD,), "clouds", "cloud")
        if cloud is None and self.cloud != "none":
            raise Error(f"no topic holds clouds ({CLOUD}); with 'cloud: none' the poses alone become a mission. The "
                        f"recording holds:{bag._list(bag.types)}", bag.path)
        frames = Frames(bag, self._max_gap, context)
        poses = self._poses(bag, cloud, frames, context)
        nodes = Nodes(poses, spacing(self.node_every))
        tally = self._fill(bag, cloud, frames, nodes, context)
        return self._mission(bag, cloud, nodes, tally, context)

    def _poses(self, bag, cloud, frames, context):
        if self.odometry == "none":
            return StandingStill()
        topic = self._pose_topic(bag)
        if bag.types[topic] in TF:
            seen = next((frame(m.header.frame_id) for _, _, m in bag.messages(cloud)), "") if cloud else ""
            poses = poses_from_tf(frames, frame(self.fixed_frame), frame(self.body_frame), seen, bag.path)
        else:
            poses = TopicPoses(bag, topic, self._max_gap, context)
            poses.body = poses.body or frame(self.body_frame)
        context.info(f"poses: '{poses.body or 'the clouds frame'}' in '{poses.fixed}', {len(poses.times)} of topic '{topic}'")
        return poses

    def _pose_topic(self, bag):
        found = bag.choose(self.odometry, POSES + (TF if self.odometry else ()), "poses", "odometry")
        moving = [t for t in bag.of_types(TF) if not t.endswith("tf_static")]
        if found or moving:
            return found or moving[0]
        raise Error(f"no topic holds poses ({', '.join(POSES + TF)}); with 'odometry: none' the sensor stood still. The "
                    f"recording holds:{bag._list(bag.types)}", bag.path)

    def _fill(self, bag, cloud, frames, nodes, context):
        if cloud is None:
            for time in nodes.poses.times:
                nodes.offer(time)
            if not nodes.nodes:
                raise Error("there is neither a cloud nor a pose to make a node of", bag.path, 2)
            return Tally(used=len(nodes.poses.times))
        tally = nodes_of_clouds(bag, cloud, nodes, self,
                                lambda name, time: self._extrinsic(bag, frames, nodes.poses.body, frame(name), time), context)
        if not nodes.nodes:
            raise no_overlap(bag, cloud, tally, nodes.poses)
        return tally

    def _extrinsic(self, bag, frames, body, cloud, time):
        """T_body_cloud"""
        if self.extrinsic:
            q = np.array(self.extrinsic[3:])
            return matrix(self.extrinsic[:3], q / np.linalg.norm(q))
        if not body or body == cloud:
            return np.eye(4)
        T = frames.at(body, cloud, time)
        if T is None:
            raise Error(f"tf does not say where the clouds' frame '{cloud}' is on '{body}' at {time / 1e9:.9f} s; give "
                        f"'extrinsic' as x y z qx qy qz qw of T_{body}_{cloud} (0 0 0 0 0 0 1 if they are the same)", bag.path)
        return T

    def _mission(self, bag, cloud, nodes, tally, context):
        times = [n.time for n in nodes.nodes]
        warnings = tally.warnings(bag.path, self.max_gap)
        gnss = None if self.gnss == "none" else bag.choose(self.gnss, (FIX,), "fixes", "gnss")
        fixes, said = fixes_of(bag, gnss, context) if gnss else ([], [])
        warnings += said
        images = self._images(bag, times, warnings, context)
        if self.side_folder and len(nodes.poses.times):
            write_odometry(nodes.poses, self.side_folder)
        clouds = "" if cloud is None else (f" of {tally.used} clouds ({tally.between} between nodes left out), "
                                           f"{tally.points} points")
        context.info(f"{len(times)} nodes{clouds}, {len(fixes)} fixes, {images} images")
        return Mission(Path(bag.path).stem, np.array([n.T for n in nodes.nodes]),
                       [divmod(t, 10**9) for t in times], fixes=fixes, warnings=warnings, platform_id=self.platform_id,
                       payloads=[source_of(bag, cloud, n, self.intensity) for n in nodes.nodes] if cloud else [])

    def _images(self, bag, times, warnings, context):
        topic = None if self.images == "none" else bag.choose(self.images, (IMAGE,), "images", "images")
        if not topic or not self.side_folder:
            return 0
        written, said = write_images(bag, topic, times, int(self.max_image_lag * 1e9),
                                     Path(self.side_folder) / "individual_images", context)
        warnings += said
        return written
