# SPDX-License-Identifier: BSD-3-Clause
"""Messages of a map, for ROS 1 and ROS 2 alike."""

import numpy as np

from .poses import quaternion

GREEN, RED, BROWN = (0.1, 0.75, 0.2, 0.9), (0.9, 0.1, 0.1, 0.5), (0.45, 0.3, 0.15, 1.0)
LINE_LIST, CYLINDER = 5, 3


class Messages:
    """Builds messages out of the classes of a typestore; fields that are not given are zero or empty."""

    def __init__(self, typestore):
        self._store, self._types, self._sequence = typestore, typestore.types, 0

    def make(self, name, /, **given):
        package, kind = name.split("/")
        full = f"{package}/msg/{kind}"
        fields = self._store.fielddefs[full][1]
        return self._types[full](**{f: given[f] if f in given else self._zero(t) for f, t in fields})

    def _zero(self, kind):
        """By the typestore's description: 1 a number or text, 2 a message, 3 an array, 4 a list."""
        node, what = int(kind[0]), kind[1]
        if node == 1:
            return "" if what[0] == "string" else 0
        if node == 2:
            package, _, name = what.split("/")
            return self.make(f"{package}/{name}")
        (inner, of), length = what
        if int(inner) == 1 and of[0] != "string":
            return np.zeros(length if node == 3 else 0, of[0])
        return [self._zero((inner, of)) for _ in range(length)] if node == 3 else []

    def header(self, frame, time):
        stamp = self.make("builtin_interfaces/Time", sec=time // 10**9, nanosec=time % 10**9)
        return self.make("std_msgs/Header", stamp=stamp, frame_id=frame)

    def _vector(self, name, v):
        return self.make(name, x=float(v[0]), y=float(v[1]), z=float(v[2]))

    def _rotation(self, T):
        return self.make("geometry_msgs/Quaternion", **dict(zip("xyzw", map(float, quaternion(T)))))

    def pose(self, T):
        return self.make("geometry_msgs/Pose", position=self._vector("geometry_msgs/Point", T[:3, 3]),
                         orientation=self._rotation(T))

    def transform(self, parent, child, time, T):
        moved = self.make("geometry_msgs/Transform", translation=self._vector("geometry_msgs/Vector3", T[:3, 3]),
                          rotation=self._rotation(T))
        one = self.make("geometry_msgs/TransformStamped", header=self.header(parent, time), child_frame_id=child,
                        transform=moved)
        return self.make("tf2_msgs/TFMessage", transforms=[one])

    def odometry(self, parent, child, time, T):
        return self.make("nav_msgs/Odometry", header=self.header(parent, time), child_frame_id=child,
                         pose=self.make("geometry_msgs/PoseWithCovariance", pose=self.pose(T)))

    def path(self, frame, time, times, poses):
        return self.make("nav_msgs/Path", header=self.header(frame, time), poses=[
            self.make("geometry_msgs/PoseStamped", header=self.header(frame, t), pose=self.pose(T))
            for t, T in zip(times, poses)])

    def fix(self, frame, time, place, sigma):
        """Of a node's position: latitude, longitude [deg], altitude above the ellipsoid [m]; sigma [m], 0: not known."""
        known = 2 if sigma > 0 else 0  # the diagonal
        return self.make("sensor_msgs/NavSatFix", header=self.header(frame, time), latitude=float(place[0]),
                         longitude=float(place[1]), altitude=float(place[2]), position_covariance_type=known,
                         position_covariance=np.diag([sigma**2] * 3).reshape(-1))

    def _marker(self, frame, time, space, number, kind, colour, T, scale, points=()):
        return self.make("visualization_msgs/Marker", header=self.header(frame, time), ns=space, id=number, type=kind,
                         pose=self.pose(T), scale=self._vector("geometry_msgs/Vector3", scale),
                         color=self.make("std_msgs/ColorRGBA", **dict(zip("rgba", colour))),
                         points=[self._vector("geometry_msgs/Point", p) for p in points])

    def lines(self, frame, time, space, number, colour, width, points):
        """Points two by two."""
        return self._marker(frame, time, space, number, LINE_LIST, colour, np.eye(4), (width, 0, 0), points)

    def stem(self, frame, time, number, base, axis, diameter, height):
        """A cylinder from `base` up along `axis`."""
        T = np.eye(4)
        side = np.cross(axis, (1.0, 0, 0) if abs(axis[0]) < 0.7 else (0, 1.0, 0))
        T[:3, 1], T[:3, 2] = side / np.linalg.norm(side), axis
        T[:3, 0] = np.cross(T[:3, 1], axis)
        T[:3, 3] = base + 0.5 * height * np.asarray(axis)
        return self._marker(frame, time, "stems", number, CYLINDER, BROWN, T, (diameter, diameter, height))

    def array(self, markers):
        return self.make("visualization_msgs/MarkerArray", markers=markers)
