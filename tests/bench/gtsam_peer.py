#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""One pose graph through GTSAM's wheel (pip install gtsam numpy): chordal start, then Gauss-Newton.

Prints: iterations, CPU seconds without parsing, F of cambium/pose_graph.hpp at the poses found.
"""

import sys
import time

import gtsam
import numpy as np


def read_edges(file):
    """(tail, head, t, q as xyzw, information 6x6 translation first) of every EDGE_SE3:QUAT."""
    upper = np.triu_indices(6)
    for line in open(file):
        word = line.split()
        if not word or word[0] != "EDGE_SE3:QUAT":
            continue
        number = np.array(word[3:], float)
        information = np.zeros((6, 6))
        information[upper] = number[7:28]
        information = information + np.triu(information, 1).T
        yield int(word[1]), int(word[2]), number[:3], number[3:7] / np.linalg.norm(number[3:7]), information


def rotation(q):
    x, y, z, w = q
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                     [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                     [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])


def cost(values, edges):
    """F = sum r' Omega r, r = [R_tail' (t_head - t_tail) - t ; 2 vec(q^-1 q_tail^-1 q_head)]."""
    F = 0.0
    for tail, head, t, q, information in edges:
        a, b = values.atPose3(tail), values.atPose3(head)
        R_tail = a.rotation().matrix()
        dR = rotation(q).T @ R_tail.T @ b.rotation().matrix()
        # 2 vec(dq), w >= 0, from the skew part of the rotation: vec = skew / (4 w).
        w = np.sqrt(max(0.0, 1 + np.trace(dR))) / 2
        skew = np.array([dR[2, 1] - dR[1, 2], dR[0, 2] - dR[2, 0], dR[1, 0] - dR[0, 1]])
        r = np.concatenate([R_tail.T @ (b.translation() - a.translation()) - t, skew / (2 * w)])
        F += r @ information @ r
    return F


def main(file):
    graph, initial = gtsam.readG2o(file, True)
    first = min(initial.keys())
    graph.add(gtsam.PriorFactorPose3(first, initial.atPose3(first),
                                     gtsam.noiseModel.Isotropic.Sigma(6, 1e-6)))
    begin = time.process_time()
    start = gtsam.InitializePose3.initialize(graph)
    parameters = gtsam.GaussNewtonParams()
    parameters.setRelativeErrorTol(1e-9)
    optimizer = gtsam.GaussNewtonOptimizer(graph, start, parameters)
    result = optimizer.optimize()
    seconds = time.process_time() - begin
    print(optimizer.iterations(), seconds, float(cost(result, read_edges(file))))


if __name__ == "__main__":
    main(sys.argv[1])
