# SPDX-License-Identifier: BSD-3-Clause
"""Distance between the poses and the truth, both seen from the first node"""
# Replace evaluate() by your method; what to keep to: docs/python-plugins.md. Its metrics are called
# python.my_method.mean and so on.
import numpy as np
from cambium import Evaluator, Metric, Param, at_least, read_truth


class MyMethod(Evaluator):
    max_time_difference = Param(0.01, "A true pose is at most so far away in time", at_least(0, "s"))

    def evaluate(self, atlas, reference, context):
        metrics = []
        for mission, truth in zip(atlas.missions, read_truth(atlas, reference, self.max_time_difference)):
            known = np.flatnonzero(np.isfinite(truth[:, 0, 3]))  # NaN: the truth has no such pose
            if len(known) == 0:
                continue
            map_first, true_first = mission.T_map_node[known[0]], truth[known[0]]
            moved = np.linalg.inv(map_first) @ mission.T_map_node[known]
            true = np.linalg.inv(true_first) @ truth[known]
            error = np.linalg.norm(moved[:, :3, 3] - true[:, :3, 3], axis=1).mean()
            metrics.append(Metric(f"{mission.name}.mean", error, "m", "lower"))
        return metrics
