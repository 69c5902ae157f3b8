# SPDX-License-Identifier: BSD-3-Clause
"""The tree of frames that tf publishes."""

import numpy as np
from cambium import Error

from .bag import frame, stamp_ns
from .poses import Track, inverse

TYPES = ("tf2_msgs/msg/TFMessage", "tf/msg/tfMessage")
BODIES = ("base_link", "base_footprint", "base", "body", "base_frame")


class Frames:
    """All transforms of the recording's tf topics. Those of a topic that ends with tf_static hold at every time."""

    def __init__(self, bag, max_gap, context):
        self._where, self._max_gap = bag.path, max_gap
        self.parent, self._static, self._tracks, self.warnings = {}, {}, {}, []
        for topic in bag.of_types(TYPES):
            static = topic.rstrip("/").endswith("tf_static")
            for _, _, message in bag.messages(topic):
                context.check_cancelled()
                for t in message.transforms:
                    self._add(t, static, topic)
        for track in self._tracks.values():
            track.finish()

    def _add(self, t, static, topic):
        parent, child = frame(t.header.frame_id), frame(t.child_frame_id)
        if self.parent.setdefault(child, parent) != parent:
            raise Error(f"topic '{topic}': the frame '{child}' has two parents, '{self.parent[child]}' and '{parent}', so "
                        f"where it is is not defined", self._where)
        track = Track(f"{self._where}: topic '{topic}', frame '{child}'")
        track = track if static else self._tracks.setdefault(child, track)
        track.add(stamp_ns(t.header), t.transform.translation, t.transform.rotation)
        if static:
            self._static[child] = track.finish().at(track.times[0], 0)

    def above(self, name):
        """The frame, its parent, and so on up to the root."""
        out = [name]
        while out[-1] in self.parent:
            out.append(self.parent[out[-1]])
            if out[-1] in out[:-1]:
                raise Error(f"tf: the frame '{name}' is above itself: {' <- '.join(out)}", self._where)
        return out

    def tied(self, a, b):
        return self.above(a)[-1] == self.above(b)[-1]

    def at(self, target, source, time):
        """T_target_source; None when one of the transforms between them is not there at that time."""
        up_a, up_b = self.above(target), self.above(source)
        common = next((f for f in up_a if f in up_b), None)
        if common is None:
            return None
        T = [self._up(up[:up.index(common)], time) for up in (up_a, up_b)]
        return None if T[0] is None or T[1] is None else inverse(T[0]) @ T[1]

    def _up(self, chain, time):
        T = np.eye(4)  # of the first of the chain, in the frame above
        for child in chain:
            step = self._static.get(child)
            if step is None and child in self._tracks:
                step = self._tracks[child].at(time, self._max_gap)
            if step is None:
                return None
            T = step @ T
        return T

    def times_between(self, target, source):
        """When the poses of source in target change: the times of the busiest transform between them."""
        up_a, up_b = self.above(target), self.above(source)
        moving = [self._tracks[f].times for f in set(up_a) ^ set(up_b) if f in self._tracks and f not in self._static]
        return max(sorted(moving), key=len, default=[])


class FramePoses:
    """T_fixed_body from tf."""

    def __init__(self, frames, fixed, body):
        self._frames, self.fixed, self.body = frames, fixed, body
        self.times = frames.times_between(fixed, body)

    def at(self, time):
        return self._frames.at(self.fixed, self.body, time)


def poses_from_tf(frames, fixed, body, cloud_frame, where):
    """`fixed`, `body`: names, or empty to choose: the body is the usual name nearest above the clouds' frame, else that
    frame; the fixed frame is the root. Error(config) when they are not tied."""
    known = sorted({*frames.parent, *frames.parent.values()})
    for flag, name in (("fixed_frame", fixed), ("body_frame", body)):
        if name and name not in known:
            raise Error(f"'{flag}': tf has no frame '{name}'; it has {', '.join(known)}", where, 2)
    if not body and not cloud_frame:
        raise Error(f"name the frame whose poses are wanted with 'body_frame'; tf has {', '.join(known)}", where, 2)
    if not body:
        if cloud_frame not in known:
            raise Error(f"tf does not tie the clouds' frame '{cloud_frame}' to anything; it has {', '.join(known)}", where)
        body = next((f for f in frames.above(cloud_frame) if f in BODIES), cloud_frame)
    fixed = fixed or frames.above(body)[-1]
    if not frames.tied(fixed, body):
        raise Error(f"tf does not tie '{body}' to '{fixed}': {' <- '.join(frames.above(body))}", where, 2)
    if fixed == body:
        raise Error(f"tf: '{body}' is the root of its tree, so it has no poses; name the frames with 'fixed_frame' and "
                    f"'body_frame' out of {', '.join(known)}", where, 2)
    return FramePoses(frames, fixed, body)
