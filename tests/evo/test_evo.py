# SPDX-License-Identifier: BSD-3-Clause
"""ATE, RPE and formats of trajectories against an independent implementation: the PyPI package evo.

test_evo.py CAMBIUM FOLDER: simulates two missions, measures them with `cambium run` and with evo.
"""

import json
import pathlib
import subprocess
import sys

try:
    import numpy as np
    from evo.core import geometry, metrics, sync
    from evo.tools import file_interface
except ModuleNotFoundError as missing:
    print(f"SKIPPED: {missing.name} is not installed; pip install evo==1.38.0")
    sys.exit(77)

DELTAS, TOLERANCE = (10.0, 20.0), 0.2
SPEC = """
version: 1
seed: 5
stand: {size: [60, 50], density: 0}
sensor: {clouds: false}
odometry: {drift: 2}
missions:
  - {name: mission_a, path: {kind: loop, size: [36, 20], spacing: 2}}
  - {name: mission_b, path: {kind: line, size: [40, 0], spacing: 3, heading: 30}}
"""
PIPELINE = f"""
version: 1
steps:
  - export: euroc
  - export: kitti
  - evaluate: ate
    params: {{alignment: se3}}
  - evaluate: ate
    label: unaligned
    params: {{alignment: none}}
  - evaluate: rpe
    params: {{deltas: {list(DELTAS)}, tolerance: {TOLERANCE}}}
"""


def rms(values):
    return float(np.sqrt(np.mean(np.square(values))))


def of_cambium(cambium, folder):
    """Metrics by name. Nothing ties the missions: the trajectories are those of the odometry."""
    (folder / "spec.yaml").write_text(SPEC)
    (folder / "pipeline.yaml").write_text(PIPELINE)
    missions, out = folder / "missions", folder / "out"
    for command in (
        ["simulate", folder / "spec.yaml", missions],
        ["run", folder / "pipeline.yaml", missions / "mission_a", missions / "mission_b",
         "--out", out, "--cache", "none"],
    ):
        subprocess.run([cambium, *command], check=True, capture_output=True)
    report = json.loads((out / "report.json").read_text())
    return {m["name"]: m["value"] for m in report["metrics"]}


def of_evo(folder, mission):
    """The same figures, named as cambium names them."""
    truth = file_interface.read_tum_trajectory_file(folder / "missions" / mission / "ground_truth.tum")
    estimate = file_interface.read_tum_trajectory_file(folder / "out" / f"{mission}.tum")
    truth, estimate = sync.associate_trajectories(truth, estimate)
    figures = {}

    def ate(trajectory):
        ape = metrics.APE(metrics.PoseRelation.translation_part)
        ape.process_data((truth, trajectory))
        return rms(ape.error)

    figures[f"unaligned.ate.{mission}.rmse"] = ate(estimate)
    errors = {"translation": [], "rotation": []}
    path = geometry.accumulated_distances(truth.positions_xyz)
    for delta in DELTAS:
        pairs = metrics.id_pairs_from_delta(truth.poses_se3, delta, metrics.Unit.meters,
                                            TOLERANCE, all_pairs=True)
        lengths = np.array([path[j] - path[i] for i, j in pairs])
        for name, relation, scale in (
            ("translation", metrics.PoseRelation.translation_part, 100),
            ("rotation", metrics.PoseRelation.rotation_angle_deg, 1),
        ):
            rpe = metrics.RPE(relation, delta, metrics.Unit.meters, rel_delta_tol=TOLERANCE,
                              all_pairs=True, pairs_from_reference=True)
            rpe.process_data((truth, estimate))
            errors[name] += list(scale * rpe.error / lengths)
    for name, values in errors.items():
        figures[f"rpe.{mission}.{name}"] = rms(values)
    estimate.align(truth)
    figures[f"ate.{mission}.rmse"] = ate(estimate)
    return figures


def other_formats_hold_the_same_poses(folder, mission):
    """EuRoC's table and KITTI's matrices, as evo reads them, against the TUM file of the run."""
    tum = file_interface.read_tum_trajectory_file(folder / "out" / f"{mission}.tum")
    table = folder / "out" / "euroc" / mission / "mav0" / "state_groundtruth_estimate0" / "data.csv"
    euroc = file_interface.read_euroc_csv_trajectory(table)
    kitti = file_interface.read_kitti_poses_file(folder / "out" / "kitti" / f"{mission}.kitti")
    assert euroc.num_poses == kitti.num_poses == tum.num_poses > 10
    assert np.allclose(euroc.timestamps, tum.timestamps, atol=1e-6)  # doubles: 0.2 microseconds
    for other in (euroc, kitti):
        assert np.allclose(other.poses_se3, tum.poses_se3, atol=1e-9)


def main():
    cambium, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    folder.mkdir(parents=True, exist_ok=True)
    ours, wrong = of_cambium(cambium, folder), 0
    for mission in ("mission_a", "mission_b"):
        other_formats_hold_the_same_poses(folder, mission)
        for name, value in of_evo(folder, mission).items():
            agree = abs(ours[name] - value) < 1e-6 and value > 1e-3
            wrong += not agree
            print(f"{name:32} cambium {ours[name]:.9f}  evo {value:.9f}  {'' if agree else 'DIFFERS'}")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
