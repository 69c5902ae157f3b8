# SPDX-License-Identifier: BSD-3-Clause
"""Iterative closest points between two thinned clouds"""
# Replace prepare() and align() by your method; what to keep to: docs/python-plugins.md.
import numpy as np
from cambium import Alignment, Param, Registration, above, at_least, between


def fit(a, b):
    """T with a = T b in the least squares sense (Umeyama 1991, without scale)."""
    mean_a, mean_b = a.mean(0), b.mean(0)
    u, _, vt = np.linalg.svd((a - mean_a).T @ (b - mean_b))
    T = np.eye(4)
    T[:3, :3] = u @ np.diag([1, 1, np.linalg.det(u @ vt)]) @ vt
    T[:3, 3] = mean_a - T[:3, :3] @ mean_b
    return T


class MyMethod(Registration):
    points = Param(600, "So many points of the source look for a partner", at_least(10))
    max_distance = Param(1.0, "Partners are at most so far apart", above(0.0, "m"))
    iterations = Param(40, "At most so many rounds", between(1, 1000))
    min_overlap = Param(0.5, "Share of the points that must find a partner", between(0, 1))

    def prepare(self, payload, context):
        """Computed once for a payload; align() finds it in target.data and source.data."""
        points = np.zeros((0, 3)) if payload.cloud is None else payload.cloud.points
        return points[np.isfinite(points).all(1)].astype(float)

    def align(self, target, source, T_target_source_guess, context):
        T, a, b = T_target_source_guess, target.data, source.data
        if not np.isfinite(T).all() or min(len(a), len(b)) < 10:
            return Alignment(False, reason="needs ten points on each side and a finite guess")
        b = b[::max(1, len(b) // self.points)]
        for _ in range(self.iterations):
            context.check_cancelled()
            moved = b @ T[:3, :3].T + T[:3, 3]
            squared = (moved**2).sum(1)[:, None] + (a**2).sum(1) - 2 * moved @ a.T
            partner = squared.argmin(1)
            squared = np.maximum(squared[np.arange(len(b)), partner], 0)
            near = squared < self.max_distance**2
            if near.mean() < self.min_overlap or near.sum() < 10:
                return Alignment(False, T, reason=f"only {near.mean():.2f} of the points overlap")
            step = fit(a[partner[near]], moved[near])
            T = step @ T
            if np.abs(step - np.eye(4)).max() < 1e-5:
                break
        scores = {"overlap": near.mean(), "rmse": np.sqrt(squared[near].mean())}
        return Alignment(True, T, np.diag([400.0] * 3 + [1e4] * 3), scores)
