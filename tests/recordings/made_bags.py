# SPDX-License-Identifier: BSD-3-Clause
"""Recordings made for the tests: a robot that walks along x at 1 m/s, with a lidar on its back."""

import numpy as np
from rosbags.rosbag1 import Writer as Writer1
from rosbags.rosbag2 import StoragePlugin
from rosbags.rosbag2 import Writer as Writer2
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

NUMBERS = {"i1": 1, "u1": 2, "i2": 3, "u2": 4, "i4": 5, "u4": 6, "f4": 7, "f8": 8}
START = 1_700_000_000 * 10**9  # [ns]


class Made:
    """A recording in the format that the name says: .bag, .mcap, or a folder of .db3."""

    def __init__(self, path):
        self.ros = 1 if path.suffix == ".bag" else 2
        self.store = get_typestore(Stores.ROS1_NOETIC if self.ros == 1 else Stores.ROS2_HUMBLE)
        if self.ros == 1:
            self.store.register(get_types_from_msg("geometry_msgs/TransformStamped[] transforms", "tf2_msgs/msg/TFMessage"))
        plugin = StoragePlugin.MCAP if path.name.endswith("mcap") else StoragePlugin.SQLITE3
        self.writer = Writer1(path) if self.ros == 1 else Writer2(path, version=8, storage_plugin=plugin)
        self.connections, self.types = {}, self.store.types

    def __enter__(self):
        self.writer.open()
        return self

    def __exit__(self, *_):
        self.writer.close()

    def put(self, topic, time, message):
        kind = message.__msgtype__
        if topic not in self.connections:
            self.connections[topic] = self.writer.add_connection(topic, kind, typestore=self.store)
        pack = self.store.serialize_ros1 if self.ros == 1 else self.store.serialize_cdr
        self.writer.write(self.connections[topic], time, pack(message, kind))

    def new(self, kind, /, **given):
        return self.types[kind.replace("/", "/msg/")](**given)

    def header(self, frame, time):
        stamp = self.new("builtin_interfaces/Time", sec=time // 10**9, nanosec=time % 10**9)
        more = {"seq": 0} if self.ros == 1 else {}
        return self.new("std_msgs/Header", stamp=stamp, frame_id=frame, **more)

    def pose(self, t, yaw=0.0):
        q = self.new("geometry_msgs/Quaternion", x=0.0, y=0.0, z=float(np.sin(yaw / 2)), w=float(np.cos(yaw / 2)))
        return self.new("geometry_msgs/Pose", position=self.new("geometry_msgs/Point", **dict(zip("xyz", map(float, t)))),
                        orientation=q)

    def odometry(self, time, t, yaw=0.0):
        zero = self.new("geometry_msgs/Vector3", x=0.0, y=0.0, z=0.0)
        twist = self.new("geometry_msgs/TwistWithCovariance", twist=self.new("geometry_msgs/Twist", linear=zero, angular=zero),
                         covariance=np.zeros(36))
        pose = self.new("geometry_msgs/PoseWithCovariance", pose=self.pose(t, yaw), covariance=np.zeros(36))
        return self.new("nav_msgs/Odometry", header=self.header("odom", time), child_frame_id="base_link", pose=pose,
                        twist=twist)

    def stamped(self, time, t, yaw=0.0):
        return self.new("geometry_msgs/PoseStamped", header=self.header("odom", time), pose=self.pose(t, yaw))

    def tf(self, parent, child, time, t, yaw=0.0):
        p = self.pose(t, yaw)
        moved = self.new("geometry_msgs/Transform", rotation=p.orientation,
                         translation=self.new("geometry_msgs/Vector3", x=p.position.x, y=p.position.y, z=p.position.z))
        one = self.new("geometry_msgs/TransformStamped", header=self.header(parent, time), child_frame_id=child,
                       transform=moved)
        return self.new("tf2_msgs/TFMessage", transforms=[one])

    def cloud(self, time, columns, frame="lidar", big=False, padding=0, rows=1):
        """`columns`: [(name, kind, values, bytes in front)]; `padding`: behind every row."""
        fields, offset = [], 0
        for name, kind, _, gap in columns:
            offset += gap
            fields.append(self.new("sensor_msgs/PointField", name=name, offset=offset, datatype=NUMBERS[kind], count=1))
            offset += int(kind[1])
        count = len(columns[0][2])
        table = np.full((count, offset), 0xAB, np.uint8)  # what lies between the fields is no zero
        for field, (_, kind, values, _) in zip(fields, columns):
            raw = np.asarray(values).astype((">" if big else "<") + kind)
            table[:, field.offset:field.offset + int(kind[1])] = raw.reshape(-1, 1).view(np.uint8)
        lines = table.reshape(rows, -1)
        data = np.hstack([lines, np.full((rows, padding), 0xCD, np.uint8)]).reshape(-1)
        return self.new("sensor_msgs/PointCloud2", header=self.header(frame, time), height=rows, width=count // rows,
                        fields=fields, is_bigendian=big, point_step=offset, row_step=len(data) // rows, data=data,
                        is_dense=False)

    def fix(self, time, place, status=0, covariance=None):
        known = 0 if covariance is None else 3
        return self.new("sensor_msgs/NavSatFix", header=self.header("gps", time), latitude=place[0], longitude=place[1],
                        altitude=place[2], status=self.new("sensor_msgs/NavSatStatus", status=status, service=1),
                        position_covariance=np.asarray(covariance if known else np.zeros(9), float).reshape(-1),
                        position_covariance_type=known)

    def image(self, time, data):
        return self.new("sensor_msgs/CompressedImage", header=self.header("camera", time), format="jpeg",
                        data=np.frombuffer(data, np.uint8))


def points_at(k, count=60):
    """What the lidar sees in scan k, in its own frame; a wall of distinct points."""
    i = np.arange(1, count + 1)
    return np.stack([i * 0.25, np.full(count, 2.0 + k), i % 7 - 3.0], axis=1)


def xyz(points, kind="f4"):
    return [(axis, kind, points[:, i], 0) for i, axis in enumerate("xyz")]


def walk(made, seconds=10, offset_of_clouds=50_000_000, clouds="/points", odometry="/odom"):
    """Odometry at 10 Hz, a cloud a second halfway between two poses, the lidar 0.5 m above the body and turned by 90
    degrees."""
    made.put("/tf_static", START, made.tf("base_link", "lidar", START, (0, 0, 0.5), np.pi / 2))
    for i in range(10 * seconds + 2):
        time = START + i * 100_000_000
        made.put(odometry, time, made.odometry(time, (0.1 * i, 0, 0), 0.01 * i))
        if i % 10 == 0 and i // 10 < seconds:
            k = i // 10
            made.put(clouds, time + offset_of_clouds + 1, made.cloud(time + offset_of_clouds, xyz(points_at(k))))
