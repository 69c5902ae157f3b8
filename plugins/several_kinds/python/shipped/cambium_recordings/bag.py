# SPDX-License-Identifier: BSD-3-Clause
"""One recording: a .bag, .mcap or .db3 file, a folder of rosbag2, or a folder of split .bag files."""

import difflib
import threading
from pathlib import Path

from cambium import Error

from .cut import what_is_whole


def files_of(path):
    """What rosbags wants to be given for `path`."""
    path = Path(path)
    if not path.is_dir() or (path / "metadata.yaml").exists():
        return [path]
    bags = sorted(path.glob("*.bag"))
    if bags:
        return bags
    # rosbag2 writes metadata.yaml last: a recorder that was killed leaves a folder without.
    stores = sorted([*path.glob("*.mcap"), *path.glob("*.db3")])
    if len(stores) == 1:
        return stores
    raise Error(f"holds {len(stores)} files of rosbag2 and no metadata.yaml; 'ros2 bag reindex' writes one", str(path))


class Bag:
    """An open recording. Times are nanoseconds. Safe to use from several threads."""

    def __init__(self, path):
        from rosbags.highlevel import AnyReader
        from rosbags.typesys import Stores, get_typestore
        self.path, self.files, self._lock = str(path), files_of(path), threading.RLock()
        with self._reading():
            for file in self._storage():
                if cut := what_is_whole(file):
                    raise Error(cut, str(file))
            # Older rosbag2 files do not say how their messages are built.
            self._reader = AnyReader(self.files, default_typestore=get_typestore(Stores.ROS2_HUMBLE))
            self._reader.open()
        self.types, self.counts = {}, {}
        for c in self._reader.connections:
            self.types[c.topic] = c.msgtype
            self.counts[c.topic] = self.counts.get(c.topic, 0) + c.msgcount
        if not sum(self.counts.values()):
            raise Error("the recording is empty: it holds no message", self.path)

    def _storage(self):
        for file in self.files:
            yield from sorted(p for p in (file.iterdir() if file.is_dir() else [file])
                              if p.suffix in (".bag", ".mcap", ".db3"))

    def _reading(self):
        return _Reading(self.path)

    def of_types(self, types):
        return [t for t in sorted(self.types) if self.types[t] in types]

    def _raw(self, topic, start=None, stop=None):
        """(connection, receive time, raw bytes) of a topic within [start, stop), in order of receive times."""
        connections = [c for c in self._reader.connections if c.topic == topic]
        with self._reading():
            yield from self._reader.messages(connections, start, stop)

    def _read(self, connection, raw):
        with self._reading():
            return self._reader.deserialize(raw, connection.msgtype)

    def messages(self, topic):
        """(receive time, raw bytes, message) of a topic, in order of receive times."""
        for connection, time, raw in self._raw(topic):
            yield time, raw, self._read(connection, raw)

    def last(self, topic):
        """The message that came last; the others are not looked into."""
        for connection, _, raw in self._raw(topic):
            pass
        return self._read(connection, raw)

    def message(self, topic, time, stamp):
        """The message received at `time` whose header has `stamp`."""
        with self._lock:  # a reader has one place in its file
            for connection, _, raw in self._raw(topic, time, time + 1):
                message = self._read(connection, raw)
                if stamp_ns(message.header) == stamp:
                    return message
        raise Error(f"the message of topic '{topic}' at {time} ns is gone; has the file changed?", self.path)

    def choose(self, wanted, types, what, flag):
        """The topic `wanted`, or the only one of these types; None when there is none. Error(config) when it is
        not there, of another type, or when there are several."""
        fit = self.of_types(types)
        if not wanted:
            if len(fit) > 1:
                raise Error(f"several topics hold {what}; name one with '{flag}':{self._list(fit)}", self.path, 2)
            return fit[0] if fit else None
        topic = wanted if wanted in self.types else "/" + wanted
        if topic not in self.types:
            near = difflib.get_close_matches(wanted, self.types, 1, 0.5)
            guess = f"; did you mean '{near[0]}'?" if near else ""
            raise Error(f"'{flag}': there is no topic '{wanted}'{guess} The recording holds:{self._list(self.types)}",
                        self.path, 2)
        if self.types[topic] not in types:
            those = f" Topics that fit:{self._list(fit)}" if fit else " No topic of the recording fits."
            raise Error(f"'{flag}': topic '{topic}' is of type {self.types[topic]}; expected {what} "
                        f"({', '.join(types)}).{those}", self.path, 2)
        if not self.counts[topic]:
            raise Error(f"topic '{topic}' holds no message", self.path)
        return topic

    def _list(self, topics):
        return "".join(f"\n  {t}  {self.types[t]}  ({self.counts[t]} messages)" for t in sorted(topics))


class _Reading:
    """What the container's reader throws at damaged files becomes an Error of the data."""

    def __init__(self, path):
        self._path = path

    def __enter__(self):
        return self

    def __exit__(self, kind, error, trace):
        if isinstance(error, Exception) and not isinstance(error, Error):
            raise Error(f"cannot be read as a recording ({kind.__name__}: {error}); expected a ROS 1 .bag, or .mcap or "
                        f".db3 of rosbag2, that is whole", self._path) from error


def stamp_ns(header):
    return header.stamp.sec * 10**9 + header.stamp.nanosec


def frame(name):
    """ROS 1 writes some frames with a slash in front."""
    return name.strip("/")
