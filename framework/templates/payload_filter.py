# SPDX-License-Identifier: BSD-3-Clause
"""Keeps the points between two heights"""
# Replace apply() by your method; what to keep to: docs/python-plugins.md.
from cambium import Param, Payload, PayloadFilter, in_unit


class MyMethod(PayloadFilter):
    lowest = Param(-5.0, "Points below this height of the base frame are dropped", in_unit("m"))
    highest = Param(30.0, "Points above this height of the base frame are dropped", in_unit("m"))

    def check_params(self):
        return "" if self.lowest < self.highest else "lowest must be below highest"

    def apply(self, mission, node, context):
        payload = mission.payload(node)
        if payload.cloud is None:
            return payload
        z = payload.cloud.points[:, 2]  # a view of the host's memory, read-only
        return Payload(payload.cloud.select((z >= self.lowest) & (z <= self.highest)), payload.trees)
