# SPDX-License-Identifier: BSD-3-Clause
"""Share of the points in each ring around the robot"""
# Replace describe() and match() by your method; what to keep to: docs/python-plugins.md.
import numpy as np
from cambium import Param, PlaceRecognizer, above, between


class MyMethod(PlaceRecognizer):
    yaw_invariant = True  # a turn on the spot moves no point to another ring
    rings = Param(40, "Fewer forgive a displacement, more tell places apart", between(1, 200))
    max_range = Param(40.0, "Points farther than this are ignored", above(0.0, "m"))
    candidates = Param(3, "At most so many proposals for a node", between(1, 1000))

    def describe(self, mission, context):
        """What is remembered of a mission: one row of numbers a node."""
        keys = np.zeros((len(mission), self.rings), np.float32)
        for node in range(len(mission)):
            context.check_cancelled()
            cloud = mission.payload(node).cloud
            if cloud is not None and len(cloud) > 0:
                ranges = np.hypot(cloud.points[:, 0], cloud.points[:, 1])
                ranges = ranges[np.isfinite(ranges)]
                keys[node] = np.histogram(ranges, self.rings, (0, self.max_range))[0] / len(cloud)
        return keys

    def match(self, query, reference, pairing, context):
        found = []
        for q, allowed in enumerate(pairing.mask()):
            context.check_cancelled()
            distance = np.abs(query.table[q] - reference.table).sum(1)
            distance[~allowed] = np.inf
            nearest = np.argsort(distance, kind="stable")[:self.candidates]
            found += [(q, r, -distance[r]) for r in nearest if allowed[r]]
        return found
