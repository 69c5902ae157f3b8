# SPDX-License-Identifier: BSD-3-Clause
"""Poses over time. Times are nanoseconds, transforms 4 x 4 T_target_source, quaternions qx qy qz qw."""

import bisect
import math

import numpy as np
from cambium import Error

from .bag import frame, stamp_ns

POSES = ("nav_msgs/msg/Odometry", "geometry_msgs/msg/PoseStamped", "geometry_msgs/msg/PoseWithCovarianceStamped",
         "geometry_msgs/msg/TransformStamped", "nav_msgs/msg/Path")


def matrix(t, q):
    x, y, z, w = q
    T = np.eye(4)
    T[:3, :3] = [[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                 [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                 [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]]
    T[:3, 3] = t
    return T


def quaternion(T):
    """qx qy qz qw of a rotation, qw >= 0 (Shepperd 1978: the largest of the four first)."""
    R = np.asarray(T)[:3, :3]
    squares = np.array([R[0, 0], R[1, 1], R[2, 2], np.trace(R)])
    i = int(np.argmax(squares))
    q = np.empty(4)
    if i == 3:
        q[:] = R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1], 1 + squares[3]
    else:
        j, k = (i + 1) % 3, (i + 2) % 3
        q[i], q[j], q[k] = 1 + R[i, i] - R[j, j] - R[k, k], R[j, i] + R[i, j], R[k, i] + R[i, k]
        q[3] = R[k, j] - R[j, k]
    q /= np.linalg.norm(q)
    return -q if q[3] < 0 else q


def inverse(T):
    out = np.eye(4)
    out[:3, :3], out[:3, 3] = T[:3, :3].T, -T[:3, :3].T @ T[:3, 3]
    return out


class Track:
    """Poses at times, interpolated between (straight line, slerp), nowhere else."""

    def __init__(self, where):
        self._where, self._rows, self.times = where, [], []

    def add(self, time, t, q):
        row = (t.x, t.y, t.z, q.x, q.y, q.z, q.w)
        norm = math.sqrt(sum(v * v for v in row[3:]))
        if not all(map(math.isfinite, row)) or norm < 1e-6:
            raise Error(f"the pose at {time / 1e9:.9f} s is {row}; expected finite numbers and a quaternion of length 1",
                        self._where)
        self._rows.append((time, *row[:3], *(v / norm for v in row[3:])))

    def finish(self):
        """Sorts by time; of several poses of one time the last that came counts."""
        last = {row[0]: row[1:] for row in self._rows}
        self.times = sorted(last)
        self._rows = [last[t] for t in self.times]
        return self

    def __len__(self):
        return len(self.times)

    def at(self, time, max_gap):
        """T at a time; None outside of the track, and within a gap of more than `max_gap` [ns]."""
        i = bisect.bisect_left(self.times, time)
        if i < len(self.times) and self.times[i] == time:
            return matrix(self._rows[i][:3], self._rows[i][3:])
        if i in (0, len(self.times)) or self.times[i] - self.times[i - 1] > max_gap:
            return None
        before, after = (np.array(self._rows[k]) for k in (i - 1, i))
        u = (time - self.times[i - 1]) / (self.times[i] - self.times[i - 1])
        return matrix((1 - u) * before[:3] + u * after[:3], _slerp(before[3:], after[3:], u))


def _slerp(a, b, u):
    cosine = float(a @ b)
    if cosine < 0:
        b, cosine = -b, -cosine  # the same rotation, the short way round
    angle = math.acos(min(1.0, cosine))
    q = (1 - u) * a + u * b if angle < 1e-6 else math.sin((1 - u) * angle) * a + math.sin(u * angle) * b
    return q / np.linalg.norm(q)


class TopicPoses:
    """The poses of a topic that has them in its messages: T_fixed_body."""

    def __init__(self, bag, topic, max_gap, context):
        self.max_gap, self.fixed, self.body = max_gap, "", ""
        track = Track(f"{bag.path}: topic '{topic}'")
        # A path says everything anew, better: the last one counts.
        for m in self._of_path(bag.last(topic)) if bag.types[topic].endswith("Path") else (
                m for _, _, m in bag.messages(topic)):
            context.check_cancelled()
            self._add(track, m)
        self.track = track.finish()
        self.times = self.track.times

    def _of_path(self, path):
        self.fixed = frame(path.header.frame_id)
        return path.poses

    def _add(self, track, m):
        if hasattr(m, "transform"):
            track.add(stamp_ns(m.header), m.transform.translation, m.transform.rotation)
        else:
            pose = m.pose if hasattr(m.pose, "position") else m.pose.pose  # with covariance: one deeper
            track.add(stamp_ns(m.header), pose.position, pose.orientation)
        self.fixed = self.fixed or frame(m.header.frame_id)
        self.body = self.body or frame(getattr(m, "child_frame_id", ""))

    def at(self, time):
        return self.track.at(time, self.max_gap)


class StandingStill:
    """--odometry none: the sensor did not move."""
    fixed = body = ""
    times = ()

    def at(self, time):
        return np.eye(4)
