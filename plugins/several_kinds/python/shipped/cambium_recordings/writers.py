# SPDX-License-Identifier: BSD-3-Clause
"""A recording written message by message: whole under its name, or not there."""

import os
import shutil
from contextlib import suppress
from pathlib import Path

from cambium import Error


class Writer:
    """Topics are made at their first message. Times are nanoseconds."""

    def __init__(self, final, store):
        from rosbags.typesys import get_types_from_msg, get_typestore
        self.final = Path(final)
        self._scratch = self.final.parent / f".tmp-{os.getpid()}-0-{self.final.name}"
        self.typestore = get_typestore(store)
        if "tf2_msgs/msg/TFMessage" not in self.typestore.fielddefs:  # rosbags leaves it out of ROS 1
            self.typestore.register(get_types_from_msg("geometry_msgs/TransformStamped[] transforms",
                                                       "tf2_msgs/msg/TFMessage"))
        self.types = self.typestore.types
        self._connections = {}

    def __enter__(self):
        shutil.rmtree(self._scratch, ignore_errors=True)
        self._scratch.mkdir()
        self._writer = self._made()
        self._writer.open()
        return self

    def __exit__(self, kind, error, trace):
        try:
            if kind is None:
                self._writer.close()
                self._keep()
        except Exception as e:
            error = e
        if error is not None:
            with suppress(Exception):  # a full disk fails here again
                self._abandon()
        shutil.rmtree(self._scratch, ignore_errors=True)
        # The bindings of SQLite have errors of their own.
        if isinstance(error, OSError) or type(error).__module__ in ("apsw", "sqlite3"):
            raise Error(f"cannot be written: {error}", str(self.final)) from error
        if kind is None and error is not None:
            raise error
        return False

    def write(self, topic, time, message, latched=False):
        kind = message.__msgtype__
        if topic not in self._connections:
            self._connections[topic] = self._connect(topic, kind, latched)
        self._writer.write(self._connections[topic], time, self._bytes(message, kind))

    def _keep(self):
        """Moves what is whole to its name, and waits until it is on the disk."""
        made = self._scratch / self.final.name
        for file in [made] if made.is_file() else sorted(made.iterdir()):
            with open(file, "rb") as f:
                os.fsync(f.fileno())
        if self.final.is_dir():
            shutil.rmtree(self.final)
        os.replace(made, self.final)


class Ros1Writer(Writer):
    """A .bag file."""
    ros = 1

    def __init__(self, final):
        from rosbags.typesys import Stores
        super().__init__(final, Stores.ROS1_NOETIC)

    def files(self):
        return [self.final]

    def _made(self):
        from rosbags.rosbag1 import Writer as Made
        return Made(self._scratch / self.final.name)

    def _abandon(self):
        self._writer.bio.close()

    def _connect(self, topic, kind, latched):
        return self._writer.add_connection(topic, kind, typestore=self.typestore, latching=1 if latched else None)

    def _bytes(self, message, kind):
        return self.typestore.serialize_ros1(message, kind)


class Ros2Writer(Writer):
    """A folder of rosbag2 (version 8 of its metadata); `storage` is mcap or sqlite3."""
    ros = 2

    def __init__(self, final, storage):
        from rosbags.typesys import Stores
        super().__init__(final, Stores.ROS2_HUMBLE)
        self._storage = storage

    def files(self):
        return sorted(self.final.iterdir())

    def _made(self):
        from rosbags.rosbag2 import StoragePlugin
        from rosbags.rosbag2 import Writer as Made
        return Made(self._scratch / self.final.name, version=8, storage_plugin=StoragePlugin[self._storage.upper()])

    def _abandon(self):
        self._writer.abort()

    def _connect(self, topic, kind, latched):
        return self._writer.add_connection(topic, kind, typestore=self.typestore,
                                           offered_qos_profiles=[_latched()] if latched else [])

    def _bytes(self, message, kind):
        return self.typestore.serialize_cdr(message, kind)


def _latched():
    """What late subscribers get, too (ROS 2: transient local)."""
    from rosbags import interfaces as i
    none = i.QosTime(0, 0)
    return i.Qos(i.QosHistory.KEEP_LAST, 1, i.QosReliability.RELIABLE, i.QosDurability.TRANSIENT_LOCAL, none, none,
                 i.QosLiveliness.AUTOMATIC, none, False)
