# SPDX-License-Identifier: BSD-3-Clause
"""sensor_msgs/PointCloud2, whatever its fields look like."""

from dataclasses import dataclass

import numpy as np
from cambium import Cloud, Error

TYPE = "sensor_msgs/msg/PointCloud2"
_NUMBERS = {1: "i1", 2: "u1", 3: "i2", 4: "u2", 5: "i4", 6: "u4", 7: "f4", 8: "f8"}


@dataclass
class Points:
    """What a message holds of use: xyz (n, 3) float32 in its own frame, intensity (n) float32 or None, label (n)
    uint8 or None; and how many of its points were left out."""
    xyz: object
    intensity: object
    label: object
    not_finite: int = 0  # a coordinate is NaN or infinite
    no_return: int = 0   # exactly at the origin: what drivers write when nothing came back

    def __len__(self):
        return len(self.xyz)

    def transformed(self, T):
        xyz = self.xyz.astype(float) @ T[:3, :3].T + T[:3, 3]
        return Points(xyz.astype(np.float32), self.intensity, self.label, self.not_finite, self.no_return)


def decode(message, where, intensity="intensity"):
    """Points of a message. Error(data) when its layout contradicts itself or lacks x, y or z."""
    columns = _Columns(message, where)
    xyz = np.stack([columns.get(axis) for axis in "xyz"], axis=-1)
    with np.errstate(over="ignore"):  # beyond a float: infinite, and left out as such
        xyz = xyz.astype(np.float32)
    finite = np.isfinite(xyz).all(axis=1)
    keep = finite & (xyz != 0).any(axis=1)
    label = next((columns.get(n) for n in ("label", "classification") if n in columns), None)
    if label is not None and not ((label[keep] >= 0) & (label[keep] <= 255)).all():
        raise Error("a label is 0 to 255, and the message has others", where)
    return Points(xyz[keep],
                  columns.get(intensity)[keep].astype(np.float32) if intensity in columns else None,
                  None if label is None else label[keep].astype(np.uint8),
                  int((~finite).sum()), int((finite & ~keep).sum()))


class _Columns:
    """The fields of a message as views of its bytes."""

    def __init__(self, m, where):
        self._m, self._where = m, where
        self._fields = {f.name: f for f in m.fields}
        # A cloud of one row may leave the length of the row out.
        self._row = m.row_step if m.height > 1 or m.row_step else m.width * m.point_step
        self._data = np.ascontiguousarray(m.data)
        if missing := [a for a in "xyz" if a not in self._fields]:
            raise Error(f"the cloud lacks the field '{missing[0]}'; it has {', '.join(self._fields) or 'none'}", where)
        if m.width and (self._row < m.width * m.point_step or len(self._data) < m.height * self._row):
            raise Error(f"the cloud states {m.height} x {m.width} points of {m.point_step} bytes in rows of {self._row}, and "
                        f"brings {len(self._data)} bytes", where)

    def __contains__(self, name):
        return name in self._fields

    def get(self, name):
        """(height * width) numbers of a field in their own type."""
        m, field = self._m, self._fields[name]
        if field.datatype not in _NUMBERS:
            raise Error(f"the field '{name}' has the datatype {field.datatype}; expected 1 to 8", self._where)
        dtype = np.dtype((">" if m.is_bigendian else "<") + _NUMBERS[field.datatype])
        if field.offset + dtype.itemsize > m.point_step:
            raise Error(f"the field '{name}' ends at byte {field.offset + dtype.itemsize} of a point of "
                        f"{m.point_step}", self._where)
        if not m.width or not m.height:
            return np.zeros(0, dtype)
        return np.ndarray((m.height, m.width), dtype, self._data, field.offset,
                          (self._row, m.point_step)).reshape(-1)


def joined(parts):
    """One Cloud of several Points. A column that one of them lacks is left out."""
    columns = [(np.concatenate([getattr(p, name) for p in parts])
                if all(getattr(p, name) is not None for p in parts) else None) for name in ("intensity", "label")]
    return Cloud(np.concatenate([p.xyz for p in parts]), None, *columns)


def encode(cloud, header, types):
    """A message of a Cloud: x y z, then intensity and label where it has them. `types`: the typestore's classes."""
    columns = [("x", "<f4", 7), ("y", "<f4", 7), ("z", "<f4", 7)]
    columns += [("intensity", "<f4", 7)] * (cloud.intensity is not None) + [("label", "u1", 2)] * (cloud.label is not None)
    # Every point on a multiple of 4 bytes: many tools look at the data as floats.
    table = np.zeros(len(cloud), np.dtype({"names": [c[0] for c in columns], "formats": [c[1] for c in columns],
                                           "offsets": range(0, 4 * len(columns), 4), "itemsize": 4 * len(columns)}))
    for i, axis in enumerate("xyz"):
        table[axis] = cloud.points[:, i]
    for name in table.dtype.names[3:]:
        table[name] = getattr(cloud, name)
    field, step = types["sensor_msgs/msg/PointField"], table.dtype.itemsize
    fields = [field(name=n, offset=table.dtype.fields[n][1], datatype=code, count=1) for n, _, code in columns]
    return types[TYPE](header=header, height=1, width=len(cloud), fields=fields, is_bigendian=False, point_step=step,
                       row_step=step * len(cloud), data=np.frombuffer(table.tobytes(), np.uint8),
                       is_dense=bool(np.isfinite(cloud.points).all()))
