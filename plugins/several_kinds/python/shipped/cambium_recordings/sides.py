# SPDX-License-Identifier: BSD-3-Clause
"""What a recording holds besides clouds and poses: fixes, images, the poses between the nodes."""

import bisect
import os
from pathlib import Path

import numpy as np
from cambium import Error, Fix

from .bag import stamp_ns
from .poses import quaternion

FIX = "sensor_msgs/msg/NavSatFix"
IMAGE = "sensor_msgs/msg/CompressedImage"
# NavSatFix without a covariance: one sigma on the plane [m] by its status (single, satellite-based, ground-based), height
# twice that; the sigmas that gnss.csv gives to the same qualities.
SIGMAS = {0: 3.0, 1: 1.0, 2: 0.02}


def fixes_of(bag, topic, context):
    """([Fix], warnings)"""
    fixes, none, unknown, seen = [], 0, 0, set()
    for _, _, m in bag.messages(topic):
        context.check_cancelled()
        place, stamp = (m.latitude, m.longitude, m.altitude), stamp_ns(m.header)
        if m.status.status < 0 or not np.isfinite(place).all() or stamp in seen:
            none += 1
            continue
        if abs(m.latitude) > 90 or abs(m.longitude) > 180:
            raise Error(f"the fix at {stamp / 1e9:.9f} s lies at latitude {m.latitude}, longitude {m.longitude}",
                        f"{bag.path}: topic '{topic}'")
        seen.add(stamp)
        covariance = np.array(m.position_covariance, float).reshape(3, 3)
        # Receivers that know no height leave its variance at 0; a sigma of 0 would outweigh everything.
        if m.position_covariance_type == 0 or not (np.isfinite(covariance).all() and (covariance.diagonal() > 0).all()):
            unknown += 1
            s = SIGMAS.get(int(m.status.status), 3.0)
            covariance = np.diag([s * s, s * s, 4 * s * s])
        fixes.append(Fix(m.header.stamp.sec, m.header.stamp.nanosec, *map(float, place), covariance))
    said = [(none, "fixes were left out: no position, or a stamp twice"),
            (unknown, "fixes have no covariance: their sigmas are those of their status")]
    return (sorted(fixes, key=lambda f: (f.sec, f.nsec)),
            [f"{bag.path}: topic '{topic}': {count} {what}" for count, what in said if count])


def write_images(bag, topic, times, max_lag, folder, context):
    """The image nearest to each node, if nearer than `max_lag` [ns], as it was compressed. Returns (written, warnings)."""
    nearest = {}
    for received, _, m in bag.messages(topic):
        context.check_cancelled()
        i = bisect.bisect_left(times, stamp := stamp_ns(m.header))
        for node in (i - 1, i):
            if 0 <= node < len(times) and abs(times[node] - stamp) <= max_lag:
                nearest[node] = min(nearest.get(node, (max_lag + 1,)), (abs(times[node] - stamp), received, stamp))
    wanted = {}
    for node, (_, received, stamp) in nearest.items():
        wanted.setdefault((received, stamp), []).append(times[node])
    written, unknown = 0, 0
    for received, _, m in bag.messages(topic):
        context.check_cancelled()
        for time in wanted.pop((received, stamp_ns(m.header)), []):
            extension = _extension(bytes(m.data[:12]))
            unknown += not extension
            written += bool(extension)
            if extension:
                folder.mkdir(parents=True, exist_ok=True)
                _write(folder / f"image_{time // 10**9}_{time % 10**9:09}{extension}", bytes(m.data))
    said = f"{bag.path}: topic '{topic}': {unknown} images were left out: neither JPEG, PNG nor WebP"
    return written, [said] if unknown else []


def _extension(head):
    """By the bytes themselves: what `format` says differs from driver to driver."""
    if head.startswith(b"\xff\xd8"):
        return ".jpg"
    if head.startswith(b"\x89PNG"):
        return ".png"
    return ".webp" if head[:4] == b"RIFF" and head[8:] == b"WEBP" else ""


def _write(path, content):
    """Whole or not at all, but without waiting for the disk: an import that a power cut ends is made again."""
    part = path.with_name(f".tmp-{os.getpid()}-0-{path.name}")
    try:
        part.write_bytes(content)
    except OSError as e:
        raise Error(f"cannot be written: {e.strerror}", str(path)) from e
    os.replace(part, path)


def write_odometry(poses, folder):
    """odometry.tum: every pose of the source, for `cambium poses`."""
    rows = []
    for time in poses.times:
        T = poses.at(time)
        if T is not None:
            rows.append(f"{time // 10**9}.{time % 10**9:09} " + " ".join(repr(float(v)) for v in [*T[:3, 3], *quaternion(T)]))
    _write(Path(folder) / "odometry.tum", ("\n".join(rows) + "\n").encode())
