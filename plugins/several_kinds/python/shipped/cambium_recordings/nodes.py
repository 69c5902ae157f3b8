# SPDX-License-Identifier: BSD-3-Clause
"""Which clouds of a recording become nodes, and which points each of them gets."""

import hashlib
import re
from dataclasses import dataclass, field

import numpy as np
from cambium import Error, Payload, Source

from .bag import stamp_ns
from .clouds import decode, joined
from .poses import inverse


def spacing(text):
    """('m' or 's', number) of "2m", "0.5 s"; None when it is neither."""
    found = re.fullmatch(r"\s*(\d+(?:\.\d*)?|\.\d+)\s*(m|s)\s*", text)
    return found and (found[2], float(found[1]))


@dataclass
class Part:
    """One message of a node's cloud: where it is in the recording, and T_node_cloud."""
    time: int   # received [ns]
    stamp: int  # in its header [ns]
    T: object


@dataclass
class Node:
    time: int    # [ns]
    T: object    # T_fixed_body
    parts: list = field(default_factory=list)
    digest: object = field(default_factory=hashlib.sha256)


@dataclass
class Tally:
    """What became of the messages and their points."""
    used: int = 0
    between: int = 0
    without_pose: int = 0
    out_of_order: int = 0
    points: int = 0
    not_finite: int = 0
    no_return: int = 0
    first: int = 0
    last: int = 0

    def warnings(self, where, max_gap):
        said = [(self.without_pose, f"clouds were left out: no pose within {max_gap:g} s on both sides of them"),
                (self.out_of_order, "clouds were left out: their stamps do not come after those before them"),
                (self.not_finite, "points were left out: a coordinate is NaN, infinite or beyond a float"),
                (self.no_return, "points were left out: they lie at the sensor's origin, so nothing came back")]
        return [f"{where}: {count} {what}" for count, what in said if count]


class Nodes:
    """A new node when the body has moved by `every` since the last one, in order of the messages."""

    def __init__(self, poses, every):
        self.poses, self.every, self.nodes, self._seen = poses, every, [], None

    def offer(self, time):
        """(node, whether it is new, T_node_body), or what is wrong with this time."""
        if self._seen is not None and time <= self._seen:
            return "out_of_order"
        T = self.poses.at(time)
        if T is None:
            return "without_pose"
        self._seen = time
        # A step that is `every` but for rounding is enough.
        if new := not self.nodes or self._moved(time, T) >= self.every[1] - 1e-9:
            self.nodes.append(Node(time, T))
        node = self.nodes[-1]
        return node, new, np.eye(4) if new else inverse(node.T) @ T  # exactly: not a bit of its points changes

    def _moved(self, time, T):
        last = self.nodes[-1]
        return (time - last.time) * 1e-9 if self.every[0] == "s" else float(np.linalg.norm(T[:3, 3] - last.T[:3, 3]))


def nodes_of_clouds(bag, topic, nodes, options, T_body_cloud, context):
    """Offers every cloud to `nodes`. `T_body_cloud(frame, time)`. Returns the tally."""
    tally, where = Tally(), f"{bag.path}: topic '{topic}'"
    count, tenth = bag.counts[topic], max(200, bag.counts[topic] // 10)
    for seen, (time, raw, message) in enumerate(bag.messages(topic), 1):
        context.check_cancelled()
        if seen % tenth == 0:
            context.info(f"read {seen} of {count} clouds, {len(nodes.nodes)} nodes")
        stamp = stamp_ns(message.header)
        tally.first, tally.last = tally.first or stamp, stamp
        found = nodes.offer(stamp)
        if isinstance(found, str):
            setattr(tally, found, getattr(tally, found) + 1)
            continue
        node, new, T_node_body = found
        if not new and options.between == "drop":
            tally.between += 1
            continue
        points = decode(message, f"{where}, stamp {stamp / 1e9:.9f}", options.intensity)
        part = Part(time, stamp, T_node_body @ T_body_cloud(message.header.frame_id, stamp))
        node.parts.append(part)
        node.digest.update(hashlib.sha256(raw).digest() + part.T.tobytes() + options.intensity.encode())
        tally.used += 1
        tally.points += len(points)
        tally.not_finite += points.not_finite
        tally.no_return += points.no_return
    return tally


def source_of(bag, topic, node, intensity):
    """The payload of a node, read when it is wanted."""
    where = f"{bag.path}: topic '{topic}', stamp {node.time / 1e9:.9f}"

    def load():
        return Payload(joined([decode(bag.message(topic, p.time, p.stamp), where, intensity).transformed(p.T)
                               for p in node.parts]))
    return Source(load, node.digest.hexdigest(), where)


def no_overlap(bag, topic, tally, poses):
    """The error of a recording in which no cloud has a pose."""
    def span(first, last):
        return f"{first / 1e9:.3f} s to {last / 1e9:.3f} s"
    times = poses.times
    theirs = f"the poses {span(times[0], times[-1])}" if len(times) else "there is no pose at all"
    return Error(f"no cloud of topic '{topic}' has a pose: the clouds go from {span(tally.first, tally.last)}, {theirs}; "
                 f"do both sensors use one clock, and is 'max_gap' large enough?", bag.path)
